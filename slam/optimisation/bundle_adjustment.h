// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "slam/camera/estimator_rig.h"
#include "slam/camera/measurement_noise.h"
#include "slam/factors/calibration_belief.h"
#include "slam/map/map.h"
#include "slam/odometry/inertial_config.h"
#include "slam/optimisation/adjustment_window.h"

namespace vinebench::slam {

struct AdjustmentOptions {
  int iterations = 6;
  double tag_corner_sigma = 0.3;            ///< px, besides the noise that a sighting knows of
  bool global = false;                      ///< all of the map: to the end; mapped tags move too
  bool tags = true;                         ///< tags that keyframes saw take part
  int min_keyframes = 1;                    ///< landmarks that fewer see are left out
  std::optional<InertialNoise> inertial{};  ///< where an inertial unit feels gravity
  /// Where the rig's calibration is unknown: what is believed of it beforehand.
  std::optional<CalibrationBelief> calibration;
  /// Where tags measure lengths beside that, and take part in no other way.
  std::optional<TagAccuracy> tag_measures{};
};

/// A bundle adjustment in three steps, so that the second can run beside tracking: what it needs of
/// the map is copied when it is made, solved, and written back. Between the first and the last step
/// the map may gain tags, but keyframes, landmarks and observations must stay as they are.
class AdjustmentJob {
 public:
  /// Keeps the rig it is given, whatever calibration finds meanwhile.
  AdjustmentJob(const Map& map, const AdjustmentWindow& window, const EstimatorRig& rig,
                const AdjustmentOptions& options);
  ~AdjustmentJob();
  AdjustmentJob(const AdjustmentJob&) = delete;
  AdjustmentJob& operator=(const AdjustmentJob&) = delete;

  /// Touches nothing but its own copies. Returns the cost reached: half the sum of the squared
  /// residuals, in standard deviations, under their loss.
  double solve();

  /// solve() is to return after the iteration that it is at. From any thread.
  void stop();

  /// After solve(): finds what is to be written back, so that apply() has less to do, and lets go
  /// of what calibration() needs. Reads keyframes and landmarks of the map that it was made of.
  void conclude(const Map& map);
  void apply(Map& map) const;

  /// What is known of the rig's calibration after solve(), where that is unknown
  /// (AdjustmentOptions::calibration): that belief and the factors' own information.
  CalibrationMarginal calibration() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Bundle adjustment, Eq. (4), (5): poses of the window's keyframes and positions of the landmarks
/// that they see, the rig's loss, weights by octave; tags seen by a keyframe take part with their
/// corners. Observations that are outliers in the end (95 % chi-square) are removed from the map.
void adjust(Map& map, const AdjustmentWindow& window, const EstimatorRig& rig,
            const AdjustmentOptions& options);

}  // namespace vinebench::slam
