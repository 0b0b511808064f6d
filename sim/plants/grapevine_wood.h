// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/util/random.h"
#include "sim/plants/grapevine_shape.h"

namespace vinebench::sim {

/// A bud: the begin of a shoot.
struct Bud {
  Eigen::Vector3f at;       ///< m
  Eigen::Vector3f towards;  ///< approximately of unit length
};

/// Adds trunk, head, arms, spurs and canes of the training, up to the fruiting wire; of a dormant
/// vine that is not pruned yet also the last summer's shoots. Returns the buds along the wire,
/// about `shoots` of them per metre.
std::vector<Bud> grow_old_wood(Grapevine& plant, const PlantBrief& brief, RandomSequence& random);

/// The thin stem of a second-year vine beside its stake, and its grow tube. Returns its buds.
std::vector<Bud> grow_young_wood(Grapevine& plant, const PlantBrief& brief, RandomSequence& random);

}  // namespace vinebench::sim
