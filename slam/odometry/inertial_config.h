// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/config/config_field.h"

namespace vinebench::slam {

/// What an inertial unit's data sheet says of three axes (unit u = rad/s or m/s^2).
struct InertialAxesConfig {
  double noise_density = 0;     ///< u/sqrt(Hz), white noise
  double bias_random_walk = 0;  ///< u/s/sqrt(Hz), white noise of the bias's rate
  double bias = 0;              ///< u, standard deviation of the bias when the unit is switched on

  template <class Archive>
  void serialize(Archive& archive) {
    archive("noise_density", noise_density, Range::positive());
    archive("bias_random_walk", bias_random_walk, Range::positive());
    archive("bias", bias, Range::positive());
  }
};

/// An inertial unit at the body's origin with the body's axes. The defaults are those of a usual
/// one (Bosch BMI088), with room for what its data sheet leaves out: vibration between two
/// readings, scale and temperature.
struct InertialConfig {
  InertialAxesConfig gyroscope{4e-4, 1e-5, 5e-3};
  InertialAxesConfig accelerometer{5e-3, 5e-4, 5e-2};

  template <class Archive>
  void serialize(Archive& archive) {
    archive("gyroscope", gyroscope);
    archive("accelerometer", accelerometer);
  }
};

/// How far wheels are believed beside an inertial unit.
struct WheelFusionConfig {
  double slip = 0.03;        ///< share of the speed from frame to frame, standard deviation
  double scale = 0.02;       ///< likewise of what stays the same: radius, load, ground
  double scale_walk = 1e-3;  ///< 1/sqrt(s), by which that changes
  double creep_walk = 1e-3;  ///< m/s/sqrt(s), by which the slip beside the wheels' motion changes

  template <class Archive>
  void serialize(Archive& archive) {
    archive("slip", slip, Range::positive());
    archive("scale", scale, Range::positive());
    archive("scale_walk", scale_walk, Range::positive());
    archive("creep_walk", creep_walk, Range::positive());
  }
};

}  // namespace vinebench::slam
