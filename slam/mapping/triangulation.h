// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "slam/camera/estimator_rig.h"
#include "slam/map/map.h"

namespace vinebench::slam {

/// The point nearest to two rays p + s d (d of unit length, map frame), by least squares. Nothing
/// where the rays are nearly parallel or meet behind either camera.
std::optional<Eigen::Vector3d> intersect_rays(const Eigen::Vector3d& p_a,
                                              const Eigen::Vector3d& d_a,
                                              const Eigen::Vector3d& p_b,
                                              const Eigen::Vector3d& d_b);

struct EpipolarMatch {
  int feature_a = 0;
  int feature_b = 0;
  Eigen::Vector3d p_map;
};

struct EpipolarSearch {
  int max_hamming = 48;       ///< bits
  double second_best = 0.85;  ///< the best must be below this share of what is alike elsewhere
  double min_depth = 0.15;    ///< m; nothing is nearer
};

/// Pairs of features of one view of two keyframes that have neither landmark nor stereo depth, look
/// more alike than any other on the epipolar line, and whose rays meet at a point that both see
/// where it is (95 % chi-square).
///
/// Whatever is on that line meets somewhere, mostly near the cameras, where a wrong landmark counts
/// most: weights go with its depth^-2.
std::vector<EpipolarMatch> match_epipolar(const Keyframe& a, const Keyframe& b, int view,
                                          const EstimatorRig& rig, const EpipolarSearch& search);

}  // namespace vinebench::slam
