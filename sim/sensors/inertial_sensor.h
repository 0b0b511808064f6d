// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "core/config/config_field.h"
#include "core/frame.h"
#include "core/truth/sample.h"
#include "core/util/random.h"

namespace vinebench::sim {

/// Three axes of a gyroscope (unit u = rad/s) or an accelerometer (u = m/s^2).
struct InertialAxesConfig {
  double noise_density = 0;       ///< u/sqrt(Hz), white noise (Allan's N)
  double bias_random_walk = 0;    ///< u/s/sqrt(Hz), white noise of the bias's rate (Allan's K)
  double bias_instability = 0;    ///< u, standard deviation of a Gauss-Markov bias
  double correlation_time = 100;  ///< s, of that bias
  double initial_bias = 0;        ///< u, standard deviation of an axis's bias at the start
  double range = 0;               ///< u, saturation; 0: none
  template <class Archive>
  void serialize(Archive& archive) {
    archive("noise_density", noise_density, Range::between(0, 100));
    archive("bias_random_walk", bias_random_walk, Range::between(0, 100));
    archive("bias_instability", bias_instability, Range::between(0, 100));
    archive("correlation_time", correlation_time, Range::between(1e-3, 1e6));
    archive("initial_bias", initial_bias, Range::between(0, 100));
    archive("range", range, Range::between(0, 1e5));
  }
};

/// An inertial unit. The defaults are typical of Bosch's BMI088 (0.014 deg/s/sqrt(Hz), 175
/// ug/sqrt(Hz), set to 500 deg/s and 6 g); bias walk and initial bias are assumptions for a unit
/// calibrated at rest.
struct InertialSensorConfig {
  InertialAxesConfig gyroscope{2.44e-4, 2e-6, 0, 100, 1e-3, 8.727};
  InertialAxesConfig accelerometer{1.72e-3, 1e-4, 0, 100, 2e-2, 58.84};
  template <class Archive>
  void serialize(Archive& archive) {
    archive("gyroscope", gyroscope);
    archive("accelerometer", accelerometer);
  }
};

/// Errors of a three-axis sensor, reading by reading.
class InertialAxes {
 public:
  InertialAxes(const InertialAxesConfig& config, const std::string& name, double rate_hz,
               std::uint64_t seed);
  /// The reading for the next true value.
  Eigen::Vector3d measure(const Eigen::Vector3d& truth);
  /// Of the next reading.
  Eigen::Vector3d bias() const { return bias_ + wandering_bias_; }
  /// A reading before the first one, which changes none of them.
  Eigen::Vector3d measure_at_start(const Eigen::Vector3d& truth) const;

 private:
  Eigen::Vector3d with_noise(const Eigen::Vector3d& truth, const Eigen::Vector3d& normal) const;
  Eigen::Vector3d draw(const RandomStream& stream, std::uint64_t index) const;

  InertialAxesConfig config_;
  double period_;  ///< s
  RandomStream noise_;
  RandomStream walk_;
  RandomStream wander_;
  RandomStream start_noise_;
  Eigen::Vector3d bias_;
  Eigen::Vector3d wandering_bias_;
  std::uint64_t index_ = 0;
};

/// Converts the physics' true readings, in order, to an inertial unit's. A draw is a function of
/// seed, axis and the reading's index.
class InertialSensor {
 public:
  InertialSensor(const InertialSensorConfig& config, double rate_hz, std::uint64_t seed);
  void measure(ImuSample& sample);
  /// Of the next reading, which is that of `stamp`.
  ImuBias bias(Stamp stamp) const;
  /// A reading before the first one, which changes none of them.
  ImuSample measured_at_start(const ImuSample& truth) const;

 private:
  InertialAxes gyroscope_;
  InertialAxes accelerometer_;
};

}  // namespace vinebench::sim
