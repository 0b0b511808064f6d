// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/config/config_field.h"
#include "core/geometry/rig.h"
#include "sim/sensors/calibration_error.h"
#include "sim/sensors/camera/camera_sensor.h"
#include "sim/sensors/frame_timing.h"
#include "sim/sensors/inertial_sensor.h"
#include "sim/sensors/wheel_sensor.h"

namespace vinebench::sim {

/// Every sensor of the rover. Each draw is a function of (seed, stream, camera or axis, frame or
/// reading), so that turning one effect on does not change another.
struct SensorsConfig {
  CameraSensorConfig camera;
  FrameTimingConfig timing;
  FrameDropConfig drops;
  CalibrationErrorConfig calibration;
  InertialSensorConfig inertial;
  WheelSensorConfig wheels;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("camera", camera);
    archive("timing", timing);
    archive("drops", drops);
    archive("calibration", calibration);
    archive("inertial", inertial);
    archive("wheels", wheels);
  }
};

/// Ideal sensors: images as rendered, readings as in the physics.
SensorsConfig perfect_sensors();

/// Throws one Error that lists inconsistencies with the rig: unknown camera names, and an exposure
/// and readout longer than the frame period.
void check_sensors(const SensorsConfig& config, const Rig& rig);

}  // namespace vinebench::sim
