// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/trajectory.h"

namespace vinebench::harness {

/// Truth and estimate of one instant.
struct PosePair {
  Stamp stamp = 0;  ///< of the truth
  Pose T_world_body;
  Pose T_map_body;
};

/// The pose nearest in time, the earlier of two that are. Needs one pose.
const StampedPose& nearest_in_time(const Trajectory& trajectory, Stamp stamp);

/// Pairs each pose of the shorter trajectory with the nearest in time of the longer, where they
/// are at most `tolerance` apart (evo's rule and its default, 0.01 s).
std::vector<PosePair> associate(const Trajectory& truth, const Trajectory& estimate,
                                Stamp tolerance = kNanosecondsPerSecond / 100);

/// T_world_map that brings the estimated positions closest to the true ones in the sense of least
/// squares, scale kept at one (Umeyama 1991; evo's `--align`). Needs one pair at least.
Pose align_se3(const std::vector<PosePair>& pairs);

/// T_world_map that makes the first poses equal (evo's `--align_origin`).
Pose align_first(const std::vector<PosePair>& pairs);

/// Of distances between true and estimated positions, m.
struct ErrorStatistics {
  double rmse = 0;
  double mean = 0;
  double median = 0;
  double max = 0;
};
ErrorStatistics position_errors(const std::vector<PosePair>& pairs, const Pose& T_world_map);

/// Relative pose error of the translation over segments of `delta` metres of the true way, percent
/// of `delta`. A segment begins at every pose and ends where the way is nearest to `delta` longer;
/// it counts when that is within a tenth of `delta`. The mean over all segments, times 100 / delta:
/// 100 times evo's mean for `evo_rpe --delta 1 --delta_unit m --all_pairs --pairs_from_reference`.
/// Nothing when the way is too short.
std::optional<double> relative_error_percent(const std::vector<PosePair>& pairs, double delta = 1);

/// Absolute and relative errors of a trajectory.
struct Evaluation {
  std::size_t pairs = 0;
  Pose T_world_map;        ///< of the SE(3) alignment
  ErrorStatistics ate;     ///< SE(3)-aligned
  ErrorStatistics origin;  ///< aligned by the first pose alone
  std::optional<double> rpe_trans_percent;
};

/// Nothing when fewer than three poses have a partner: any shape can be aligned with that.
std::optional<Evaluation> evaluate(const Trajectory& truth, const Trajectory& estimate);

}  // namespace vinebench::harness
