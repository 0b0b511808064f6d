// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "slam/calibration/calibration_average.h"
#include "slam/calibration/calibration_config.h"
#include "slam/optimisation/bundle_adjustment.h"

namespace vinebench::slam {

/// Watches by what the rig's calibration is off, as the map itself shows it.
///
/// A camera that looks a little to the side of where the rig file has it measures all disparities
/// wrong by the same number of pixels; then what is near and what is far tell of different scales.
/// A pair that is mounted otherwise, or triggered at another time, sees the body move otherwise
/// than the other pairs do, and than a tag camera sees it move past a tag, which also is a measure
/// of length (TagMeasures); and where a tag camera has a time of its own, what it sees of a tag is
/// ahead or behind as the body speeds up or turns. So each dozen of keyframes is adjusted by itself
/// with PairCalibration, the tag cameras' times and the body's velocities as further unknowns;
/// before the first dozen is complete, its first half, which is not added up. What it says of them,
/// while all its poses and landmarks are unknown too, is added up over the drive, beside the rig
/// file's own accuracy, so that what the motion does not show stays where the file has it. A
/// calibration is replaced where the rig file is hardly right, and the likelihood ratio of what is
/// known then beyond chance.
///
/// How much the dozens differ from each other tells how far their information is to be trusted:
/// errors that are no property of the cameras (leaves in the wind, noise of other kinds) make them
/// differ by more than their own covariances say. Two dozens in a row that have nothing to do with
/// those before, but with each other, mean that the cameras were knocked: then they alone count. Of
/// a rig of one pair the disparity offset alone is corrected, if it is large, and once.
class CalibrationWatch {
 public:
  /// `disparity_sigma`: px, accuracy of disparity offsets.
  CalibrationWatch(const CalibrationConfig& accuracy, double disparity_sigma,
                   const EstimatorRig& rig);

  /// Whether enough keyframes came: six for the first look, then a dozen, later four dozens.
  bool due(const Map& map) const;

  /// Keyframes before this one are not looked at: those of a loaded map.
  void begin(std::size_t keyframe) { looked_ = keyframe; }

  /// Looks at the latest keyframes. The calibrations, where they are now known to
  /// differ from the rig's; otherwise none. The map is not touched.
  std::optional<RigCalibration> look(const Map& map, const EstimatorRig& rig,
                                     const AdjustmentOptions& options);

  /// look() in two steps, between which the first one's job is to be solved, on any thread.
  std::unique_ptr<AdjustmentJob> begin_look(const Map& map, const EstimatorRig& rig,
                                            const AdjustmentOptions& options);
  std::optional<RigCalibration> finish_look(const CalibrationMarginal& found,
                                            const EstimatorRig& rig);

  /// The calibrations as they are known now, if they were replaced once.
  std::optional<RigCalibration> latest() const;

  /// What is known of the calibrations now.
  CalibrationBelief known() const;

  /// Second moments of the error that the rig's calibrations have now, as far as is known
  /// (CalibrationAverage): of to_vector().
  Eigen::MatrixXd error(const EstimatorRig& rig) const;

  /// By how much such errors move the body from one keyframe to the next, as the last look had it:
  /// steps of step_of in six rows, a column for each number of to_vector(). Zero before. The
  /// columns of times and readouts are zero: these move single frames (ErrorOfImageTimes).
  const Eigen::MatrixXd& drift() const { return drift_; }

 private:
  std::unique_ptr<AdjustmentJob> job(std::size_t keyframes, const Map& map, const EstimatorRig& rig,
                                     const AdjustmentOptions& options) const;
  void keep_drift(const CalibrationMarginal& marginal, std::size_t keyframes);
  std::optional<RigCalibration> look_at_one_pair(const CalibrationBelief& now,
                                                 const EstimatorRig& rig);
  void add(const CalibrationBelief& part);
  double distance_to(const CalibrationBelief& others, const CalibrationBelief& part) const;
  double spread() const;

  CalibrationConfig accuracy_;
  std::size_t pairs_;
  CalibrationBelief prior_;
  CalibrationBelief parts_;                    ///< sum of what the dozens say
  std::optional<CalibrationBelief> stranger_;  ///< the last one, if it contradicts the others
  CalibrationAverage average_;                 ///< of what is known
  Eigen::MatrixXd drift_;
  double chi_squared_ = 0;  ///< of the dozens against those before
  double freedom_ = 0;      ///< numbers that these chi-squares are of
  std::size_t looked_ = 0;  ///< keyframes
  int looks_ = 0;
  bool replaced_ = false;
};

}  // namespace vinebench::slam
