// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/geometry/rig.h"
#include "core/slam_system.h"
#include "core/truth/site.h"

namespace vinebench::harness {

/// Something that the estimator is told and that is not so.
struct Discrepancy {
  std::string of;    ///< what it is told of, such as "front pair", "side", "tag 0"
  std::string what;  ///< such as "baseline"
  double size = 0;   ///< told less true, in `unit`; a magnitude for rotations and distances
  std::string unit;  ///< "%", "px", "deg", "mm", "ms", or empty
  /// How far it moves what is seen at a distance of 1 m, px: an order of magnitude, by which those
  /// of one run are compared.
  double pixels = 0;
};

/// In calibration: baselines, lenses, mounts of pairs and of cameras to each other, swapped
/// cameras. An error that all cameras of a pair share is one of the pair, and one that all pairs
/// share is one of "all pairs". Both rigs have the same cameras and pairs; those of less than 0.1
/// px are left out.
std::vector<Discrepancy> rig_discrepancies(const Rig& told, const Rig& truth);

/// In the survey of tags: place, orientation, size, and tags that do not stand in the world.
/// `focal` is the focal length of the camera that reads them, px.
std::vector<Discrepancy> tag_discrepancies(const std::vector<RegisteredTag>& told,
                                           const std::vector<WorldTag>& truth, double focal);

/// The one that moves the images most first.
void rank(std::vector<Discrepancy>& discrepancies);

/// Such as "front pair: baseline 2.0 % too large".
std::string text_of(const Discrepancy& discrepancy);

/// One readable line of them all; empty without any.
std::string format_discrepancies(const std::vector<Discrepancy>& discrepancies);

}  // namespace vinebench::harness
