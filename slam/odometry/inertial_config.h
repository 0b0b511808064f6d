// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/config/config_field.h"
#include "core/geometry/rig.h"

namespace vinebench::slam {

/// What is known of three axes of an inertial unit (unit u = rad/s or m/s^2).
struct InertialAxesConfig {
  std::optional<double> noise_density;     ///< u/sqrt(Hz), white noise; default: the rig file's
  std::optional<double> bias_random_walk;  ///< u/s/sqrt(Hz), of the bias; default: the rig file's
  std::optional<double> bias;  ///< u, standard deviation of the bias when the unit is switched on

  template <class Archive>
  void serialize(Archive& archive) {
    archive("noise_density", noise_density, Range::positive());
    archive("bias_random_walk", bias_random_walk, Range::positive());
    archive("bias", bias, Range::positive());
  }
};

/// An inertial unit at the body's origin with the body's axes.
struct InertialConfig {
  InertialAxesConfig gyroscope;
  InertialAxesConfig accelerometer;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("gyroscope", gyroscope);
    archive("accelerometer", accelerometer);
  }
};

/// What the estimator takes an inertial unit's errors to be (unit u = rad/s or m/s^2). The defaults
/// are those of a usual one (Bosch BMI088), with room for what its data sheet leaves out: vibration
/// between two readings, scale and temperature.
struct InertialNoise {
  struct Axes {
    double noise_density = 0;     ///< u/sqrt(Hz)
    double bias_random_walk = 0;  ///< u/s/sqrt(Hz)
    double bias = 0;              ///< u, standard deviation when the unit is switched on
  };
  Axes gyroscope{4e-4, 1e-5, 5e-3};
  Axes accelerometer{5e-3, 5e-4, 5e-2};
};

/// Where an inertial unit takes part: what was set, else what the rig's file says, else the
/// default.
std::optional<InertialNoise> inertial_noise(const std::optional<InertialConfig>& config,
                                            const std::optional<ImuNoise>& of_rig);

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
