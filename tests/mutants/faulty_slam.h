// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/slam_system.h"

namespace vinebench::mutants {

/// How a SLAM system misreports what it has estimated; `size` is EstimatorFault's.
enum class Fault {
  kScale,         ///< distances from the first pose are too large by the share `size`
  kLate,          ///< each pose is the one of `size` s before
  kJump,          ///< a step of `size` m to the left in the middle of the run, which stays
  kJumpBack,      ///< the same for a second
  kDrift,         ///< to the left by the share `size` of the path
  kHeadingDrift,  ///< the heading turns by `size` rad for each metre of the path
  kTilt,          ///< rolled by `size` rad from the middle on
  kClimb,         ///< rises by the share `size` of the path
  kFrozen,        ///< stands still for `size` s, and calls it tracked
  kSilentLoss,    ///< lost for `size` s, and calls a constant velocity tracked
  kOpenLoss,      ///< lost for `size` s, and says so
  kNoise,         ///< white noise of `size` m on each coordinate
  kCovariance,    ///< covariances are `size` times too large
  kFalseLoop,     ///< reports a closure that is wrong by `size` m, and moves there
  kWorld,         ///< the map's pose in the world is wrong by `size` m
};

struct EstimatorFault {
  Fault fault{};
  double size = 0;
};

/// What a system with this fault reports instead of the pose of `honest` at `index`; `middle` is
/// the stamp of the middle of the run.
Pose misreported(const Trajectory& honest, std::size_t index, const EstimatorFault& fault,
                 Stamp middle);

/// A system around another one that misreports its estimate in one way.
class FaultySlam : public SlamSystem {
 public:
  /// In a run of `frames` frames at `rate_hz`.
  FaultySlam(SlamSystem& inner, EstimatorFault fault, std::int64_t frames, double rate_hz);

  Estimate process(const Frame& frame) override;
  SlamSummary finish() override;
  const StageTimes& times() const override { return inner_.times(); }

 private:
  bool is_in_window(Stamp stamp) const;
  void close_falsely(Estimate& estimate);

  SlamSystem& inner_;
  EstimatorFault fault_;
  Stamp middle_;
  Trajectory live_;
  std::optional<Stamp> closed_;
};

}  // namespace vinebench::mutants
