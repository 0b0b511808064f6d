// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/util/stage_timer.h"
#include "slam/calibration/calibration_watch.h"
#include "slam/runtime/background.h"

namespace vinebench::slam {

/// How a rig's calibrations are watched over a drive.
struct SelfCalibrationSettings {
  CalibrationConfig accuracy{};  ///< of the rig file
  double disparity_sigma = 1;    ///< px, of its disparity offsets
  bool enabled = true;           ///< else nothing is looked at, and errors are those of the file
  bool beside_tracking = false;  ///< looks take their time on a thread of their own
};

/// Whether somebody said how accurate the rig file is. The defaults are wide enough for any rig:
/// taken for an error that it has, they would make the covariances of most useless.
bool is_accuracy_told(const CalibrationConfig& accuracy, double disparity_sigma);

/// CalibrationWatch over a drive: when it looks, at once or beside tracking, and what error the
/// rig's calibrations have by the latest look.
class SelfCalibration {
 public:
  SelfCalibration(const SelfCalibrationSettings& settings, const EstimatorRig& rig);

  /// Keyframes before this one are not looked at: those of a loaded map.
  void begin(std::size_t keyframe) { watch_.begin(keyframe); }

  /// After each keyframe. The calibrations to go on with, where a look that ended found others than
  /// the rig's; error() is of these. Times what it does as "calibration".
  std::optional<RigCalibration> after_keyframe(const Map& map, const EstimatorRig& rig,
                                               const AdjustmentOptions& options, StageTimes& times);

  /// Waits for a look that is under way.
  void finish();

  /// The calibrations as they are known now, if they were replaced once.
  std::optional<RigCalibration> latest() const { return watch_.latest(); }

  /// As CalibrationWatch has them; error() is empty where it is switched off.
  const Eigen::MatrixXd& error() const { return error_; }
  const Eigen::MatrixXd& drift() const { return watch_.drift(); }

 private:
  /// What a look beside tracking leaves.
  struct Look {
    CalibrationWatch watch;
    std::optional<RigCalibration> found;
  };

  void start_look(const Map& map, const EstimatorRig& rig, const AdjustmentOptions& options);
  std::optional<RigCalibration> take_look();
  void know_error(const EstimatorRig& rig, const std::optional<RigCalibration>& found);

  SelfCalibrationSettings settings_;
  CalibrationWatch watch_;
  Background<Look> look_;  ///< beside tracking
  Eigen::MatrixXd error_;
};

}  // namespace vinebench::slam
