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

/// The pose nearest in time, the earlier one of two. Requires at least one pose.
const StampedPose& nearest_in_time(const Trajectory& trajectory, Stamp stamp);

/// Pairs each pose of the shorter trajectory with the nearest in time of the longer, if they are at
/// most `tolerance` apart (evo's rule and its default, 0.01 s).
std::vector<PosePair> associate(const Trajectory& truth, const Trajectory& estimate,
                                Stamp tolerance = kNanosecondsPerSecond / 100);

/// T_world_map that brings the estimated positions closest to the true ones in the least-squares
/// sense, without scale (Umeyama 1991; evo's `--align`). Requires at least one pair.
Pose align_se3(const std::vector<PosePair>& pairs);

/// T_world_map that aligns the first poses (evo's `--align_origin`).
Pose align_first(const std::vector<PosePair>& pairs);

/// Of distances between true and estimated positions, m.
struct ErrorStatistics {
  double rmse = 0;
  double mean = 0;
  double median = 0;
  double max = 0;
  double p95 = 0;  ///< 95 % of the poses are within it
};
ErrorStatistics position_errors(const std::vector<PosePair>& pairs, const Pose& T_world_map);

/// Relative pose error of the translation over segments of `delta` metres of the true path, percent
/// of `delta`. A segment begins at every pose and ends at the pose whose path length is nearest to
/// `delta`; it counts if that is within a tenth of `delta`. The mean over all segments, times 100 /
/// delta: 100 times evo's mean for `evo_rpe --delta 1 --delta_unit m --all_pairs
/// --pairs_from_reference`. Empty if the path is too short.
std::optional<double> relative_error_percent(const std::vector<PosePair>& pairs, double delta = 1);

/// From one body's x axis to the other's, seen from above, rad, -pi to pi.
double heading_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to);

/// Of angles, rad.
struct AngleStatistics {
  double rmse = 0;
  double max = 0;
};
/// Errors of the body's orientation in the world: heading, by which the estimated and the true x
/// axis differ seen from above, and tilt, the angle between the estimated and the true z axis.
struct OrientationErrors {
  AngleStatistics heading;
  AngleStatistics tilt;
};
OrientationErrors orientation_errors(const std::vector<PosePair>& pairs, const Pose& T_world_map);

/// The frame with the largest position error.
struct WorstFrame {
  Stamp stamp = 0;   ///< of the truth
  double error = 0;  ///< m
};
/// The first one of several. Requires at least one pair.
WorstFrame worst_frame(const std::vector<PosePair>& pairs, const Pose& T_world_map);

/// Errors in the world as the system itself has placed its map there, without any alignment.
struct WorldErrors {
  ErrorStatistics position;
  OrientationErrors orientation;
};

/// Absolute and relative errors of a trajectory.
struct Evaluation {
  std::size_t pairs = 0;
  Pose T_world_map;               ///< of the SE(3) alignment
  ErrorStatistics ate;            ///< SE(3)-aligned
  ErrorStatistics origin;         ///< aligned by the first pose only
  OrientationErrors orientation;  ///< likewise
  WorstFrame worst;               ///< likewise
  std::optional<double> rpe_trans_percent;
  std::optional<WorldErrors> world;  ///< absent if the system gives no pose in the world
};

/// `T_world_map` is the system's own estimate. Empty if fewer than three poses are associated: the
/// alignment would be undetermined.
std::optional<Evaluation> evaluate(const Trajectory& truth, const Trajectory& estimate,
                                   const std::optional<Pose>& T_world_map = std::nullopt);

/// How far an estimate drifts that no loop closure has corrected.
struct Drift {
  double error = 0;    ///< m, largest position error, aligned by the first pose only
  double percent = 0;  ///< of the true path; 0 where there is none
};

/// Of the poses before `until`. Empty if there are fewer than two.
std::optional<Drift> drift_before(Stamp until, const Trajectory& truth, const Trajectory& live);

}  // namespace vinebench::harness
