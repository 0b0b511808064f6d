// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"

namespace vinebench::slam {

struct ProjectionSearch {
  double radius = 10;         ///< px at level 0; grows with the predicted level
  int max_hamming = 64;       ///< bits
  double second_best = 0.85;  ///< the best must be below this share of the next best
};

/// Looks for landmarks among the features of a frame: each is projected into every pair of the rig
/// (a landmark of the front pair is found by the back pair too), and compared with the features
/// near its projection and of its predicted scale. Features and landmarks that `associations` ties
/// already stay so; new ties are added. Returns how many were added.
int match_by_projection(const Map& map, const std::vector<int>& landmarks,
                        const FrameFeatures& frame, const Pose& T_map_body, const EstimatorRig& rig,
                        const ProjectionSearch& search, Associations& associations);

/// The feature of one view that looks like the landmark near its projection, or -1. Features with
/// `taken` >= 0 are passed over where `skip_taken`.
int find_feature(const Landmark& landmark, const StereoView& view, int v, const Pose& T_body_map,
                 const EstimatorRig& rig, double level_scale, const ProjectionSearch& search,
                 const std::vector<int>* taken);

}  // namespace vinebench::slam
