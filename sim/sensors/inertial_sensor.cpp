// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/inertial_sensor.h"

#include <cmath>

namespace vinebench::sim {

InertialAxes::InertialAxes(const InertialAxesConfig& config, const std::string& name,
                           double rate_hz, std::uint64_t seed)
    : config_(config),
      period_(1 / rate_hz),
      noise_(seed, name + ".noise"),
      walk_(seed, name + ".bias_walk"),
      wander_(seed, name + ".bias_wander"),
      start_noise_(seed, name + ".start_noise"),
      bias_(config.initial_bias * draw(RandomStream(seed, name + ".initial_bias"), 0)),
      wandering_bias_(config.bias_instability * draw(wander_, 0)) {}

Eigen::Vector3d InertialAxes::draw(const RandomStream& stream, std::uint64_t index) const {
  return {stream.normal(3 * index), stream.normal(3 * index + 1), stream.normal(3 * index + 2)};
}

/// A reading is the mean over its period, so the variance of the white noise is N^2 / period.
Eigen::Vector3d InertialAxes::with_noise(const Eigen::Vector3d& truth,
                                         const Eigen::Vector3d& normal) const {
  const Eigen::Vector3d white = config_.noise_density / std::sqrt(period_) * normal;
  const Eigen::Vector3d reading = truth + bias_ + wandering_bias_ + white;
  if (config_.range <= 0) return reading;
  return reading.cwiseMax(-config_.range).cwiseMin(config_.range);
}

Eigen::Vector3d InertialAxes::measure_at_start(const Eigen::Vector3d& truth) const {
  return with_noise(truth, draw(start_noise_, 0));
}

Eigen::Vector3d InertialAxes::measure(const Eigen::Vector3d& truth) {
  const Eigen::Vector3d reading = with_noise(truth, draw(noise_, index_));
  ++index_;
  bias_ += config_.bias_random_walk * std::sqrt(period_) * draw(walk_, index_);
  const double kept = std::exp(-period_ / config_.correlation_time);
  wandering_bias_ = kept * wandering_bias_ +
                    config_.bias_instability * std::sqrt(1 - kept * kept) * draw(wander_, index_);
  return reading;
}

InertialSensor::InertialSensor(const InertialSensorConfig& config, double rate_hz,
                               std::uint64_t seed)
    : gyroscope_(config.gyroscope, "imu.gyroscope", rate_hz, seed),
      accelerometer_(config.accelerometer, "imu.accelerometer", rate_hz, seed) {}

ImuSample InertialSensor::measured_at_start(const ImuSample& truth) const {
  return {truth.stamp, gyroscope_.measure_at_start(truth.angular_velocity),
          accelerometer_.measure_at_start(truth.specific_force)};
}

ImuBias InertialSensor::bias(Stamp stamp) const {
  return {stamp, gyroscope_.bias(), accelerometer_.bias()};
}

void InertialSensor::measure(ImuSample& sample) {
  sample.angular_velocity = gyroscope_.measure(sample.angular_velocity);
  sample.specific_force = accelerometer_.measure(sample.specific_force);
}

}  // namespace vinebench::sim
