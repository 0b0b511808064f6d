// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/util/random.h"
#include "sim/plants/grapevine.h"

namespace vinebench::sim {

/// Where a shoot begins.
struct Bud {
  Eigen::Vector3f at;       ///< m
  Eigen::Vector3f towards;  ///< about unit
};

/// Adds trunk, head, arms, spurs and canes as the training has them, up to the fruiting wire.
/// Returns the buds along the wire, about `shoots` of them a metre.
std::vector<Bud> grow_old_wood(Grapevine& plant, const PlantBrief& brief, RandomSequence& random);

/// The thin stem of a second-year vine beside its stake, and its grow tube. Returns its buds.
std::vector<Bud> grow_young_wood(Grapevine& plant, const PlantBrief& brief, RandomSequence& random);

}  // namespace vinebench::sim
