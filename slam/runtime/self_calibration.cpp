// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/self_calibration.h"

#include <memory>
#include <utility>

#include "slam/stereo/stereo_matcher.h"

namespace vinebench::slam {

bool is_accuracy_told(const CalibrationConfig& told, double disparity_sigma) {
  const CalibrationConfig usual;
  return told.position != usual.position || told.rotation_deg != usual.rotation_deg ||
         told.disparity_slope != usual.disparity_slope || told.focal != usual.focal ||
         told.baseline != usual.baseline || told.time != usual.time ||
         told.readout != usual.readout || told.principal_point != usual.principal_point ||
         told.right_turn_deg != usual.right_turn_deg || told.right_ahead != usual.right_ahead ||
         told.tag_camera_position != usual.tag_camera_position ||
         told.tag_camera_rotation_deg != usual.tag_camera_rotation_deg ||
         disparity_sigma != StereoConfig{}.calibration_sigma;
}

SelfCalibration::SelfCalibration(const SelfCalibrationSettings& settings, const EstimatorRig& rig)
    : settings_(settings), watch_(settings.accuracy, settings.disparity_sigma, rig) {
  if (settings.enabled) error_ = watch_.error(rig);
}

std::optional<RigCalibration> SelfCalibration::after_keyframe(const Map& map,
                                                              const EstimatorRig& rig,
                                                              const AdjustmentOptions& options,
                                                              StageTimes& times) {
  if (!settings_.enabled) return std::nullopt;
  if (!settings_.beside_tracking) {
    if (!watch_.due(map)) return std::nullopt;
    const ScopedTimer timer(times, "calibration");
    const auto found = watch_.look(map, rig, options);
    know_error(rig, found);
    return found;
  }
  std::optional<RigCalibration> found;
  if (look_.done()) {
    found = take_look();
    know_error(rig, found);
  }
  if (!look_.busy() && watch_.due(map)) {
    start_look(map, found ? rig.with_calibration(*found) : rig, options);
  }
  return found;
}

/// Of a copy of the watch: to weigh what may be wrong with the rig takes longer than a frame has.
void SelfCalibration::start_look(const Map& map, const EstimatorRig& rig,
                                 const AdjustmentOptions& options) {
  const std::shared_ptr<AdjustmentJob> job = watch_.begin_look(map, rig, options);
  look_.start([job, rig, before = watch_] {
    Look look{before, {}};
    job->solve();
    look.found = look.watch.finish_look(job->calibration(), rig);
    return look;
  });
}

void SelfCalibration::finish() {
  if (look_.busy()) take_look();
}

std::optional<RigCalibration> SelfCalibration::take_look() {
  Look look = look_.take();
  watch_ = std::move(look.watch);
  return look.found;
}

void SelfCalibration::know_error(const EstimatorRig& rig,
                                 const std::optional<RigCalibration>& found) {
  error_ = watch_.error(found ? rig.with_calibration(*found) : rig);
}

}  // namespace vinebench::slam
