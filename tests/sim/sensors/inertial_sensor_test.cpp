// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/inertial_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace vinebench::sim {
namespace {

constexpr double kRate = 100;  // Hz

std::vector<double> readings(const InertialAxesConfig& config, std::size_t count,
                             std::uint64_t seed = 1) {
  InertialAxes axes(config, "test", kRate, seed);
  std::vector<double> values(count);
  for (double& value : values) value = axes.measure(Eigen::Vector3d::Zero()).x();
  return values;
}

/// Allan deviation over adjacent clusters of `seconds` (IEEE Std 952-1997, C.3).
double allan_deviation(const std::vector<double>& values, double seconds) {
  const auto n = static_cast<std::size_t>(std::lround(seconds * kRate));
  std::vector<double> means;
  for (std::size_t i = 0; i + n <= values.size(); i += n) {
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += values[i + k];
    means.push_back(sum / static_cast<double>(n));
  }
  double sum = 0;
  for (std::size_t i = 1; i < means.size(); ++i) {
    sum += (means[i] - means[i - 1]) * (means[i] - means[i - 1]);
  }
  return std::sqrt(0.5 * sum / static_cast<double>(means.size() - 1));
}

TEST(InertialSensorTest, AReadingAtTheStartChangesNoOther) {
  InertialAxesConfig config;
  config.noise_density = 2e-3;
  config.bias_random_walk = 1e-3;
  config.initial_bias = 0.5;
  InertialAxes axes(config, "test", kRate, 1);
  const double start = axes.measure_at_start(Eigen::Vector3d::Zero()).x();
  const std::vector<double> others = readings(config, 3);
  for (const double other : others) {
    EXPECT_EQ(axes.measure(Eigen::Vector3d::Zero()).x(), other);
  }
  // It has the bias, and white noise of its own: N / sqrt(10 ms) is 0.02; five of those.
  EXPECT_NE(start, others[0]);
  EXPECT_NEAR(start, others[0], 0.1);
}

TEST(InertialSensorTest, WhiteNoiseHasItsAllanDeviation) {
  InertialAxesConfig config;
  config.noise_density = 2e-3;
  const std::vector<double> values = readings(config, 400000);  // 4000 s
  for (const double tau : {0.1, 1.0, 10.0}) {
    // N / sqrt(tau). Of m = 4000 s / tau clusters, the deviation's own standard error is
    // sqrt(3 / (4 m)) of it; three of those.
    const double expected = config.noise_density / std::sqrt(tau);
    EXPECT_NEAR(allan_deviation(values, tau), expected, 3 * expected * std::sqrt(0.75 * tau / 4000))
        << tau;
  }
}

TEST(InertialSensorTest, BiasWalkRisesAtLongTimes) {
  InertialAxesConfig config;
  config.noise_density = 1e-3;
  config.bias_random_walk = 1e-3;
  const std::vector<double> values = readings(config, 2000000);  // 20000 s
  for (const double tau : {1.0, 30.0, 100.0}) {
    // sigma^2 = N^2 / tau + K^2 tau / 3; at 100 s the second term is 3333 times the first.
    const double expected = std::sqrt(1e-6 / tau + 1e-6 * tau / 3);
    // Steps of a walk are correlated between neighbouring clusters: four standard errors.
    EXPECT_NEAR(allan_deviation(values, tau), expected, 4 * expected * std::sqrt(tau / 20000))
        << tau;
  }
}

TEST(InertialSensorTest, InstabilityIsStationary) {
  InertialAxesConfig config;
  config.bias_instability = 0.01;
  config.correlation_time = 1;
  const std::vector<double> values = readings(config, 400000);
  double sum = 0;
  for (const double value : values) sum += value * value;
  // 4000 s have about 2000 independent values: the deviation's standard error is 1 / sqrt(2 *
  // 2000).
  EXPECT_NEAR(std::sqrt(sum / 400000), 0.01, 0.01 * 3 / std::sqrt(4000.0));
}

TEST(InertialSensorTest, InitialBiasStaysWithTheSeed) {
  InertialAxesConfig config;
  config.initial_bias = 0.5;
  const std::vector<double> values = readings(config, 100);
  EXPECT_NE(values.front(), 0);
  EXPECT_EQ(values.front(), values.back());
  EXPECT_EQ(values, readings(config, 100));
  EXPECT_NE(values, readings(config, 100, 2));
}

TEST(InertialSensorTest, TheBiasIsWhatAReadingHasBesidesTruthAndNoise) {
  InertialSensorConfig config;
  for (InertialAxesConfig* axes : {&config.gyroscope, &config.accelerometer}) {
    axes->noise_density = 0;
    axes->bias_random_walk = 0.01;
    axes->bias_instability = 0.02;
    axes->initial_bias = 0.1;
    axes->range = 0;
  }
  InertialSensor sensor(config, 200, 3);
  for (int i = 0; i < 5; ++i) {
    ImuSample sample{.stamp = i, .angular_velocity = {1, 2, 3}, .specific_force = {0, 0, 9.81}};
    const ImuBias bias = sensor.bias(sample.stamp);
    EXPECT_EQ(bias.stamp, i);
    sensor.measure(sample);
    // Differences of numbers of 10: rounding to 1e-15.
    EXPECT_LT((sample.angular_velocity - Eigen::Vector3d(1, 2, 3) - bias.angular_velocity).norm(),
              1e-14);
    EXPECT_LT((sample.specific_force - Eigen::Vector3d(0, 0, 9.81) - bias.specific_force).norm(),
              1e-14);
    EXPECT_GT(bias.specific_force.norm(), 1e-3);
  }
}

TEST(InertialSensorTest, SaturationClips) {
  InertialAxesConfig config;
  config.range = 2;
  InertialAxes axes(config, "test", kRate, 1);
  EXPECT_EQ(axes.measure({3, -5, 1.5}), Eigen::Vector3d(2, -2, 1.5));
}

TEST(InertialSensorTest, AllZeroIsTheTruth) {
  InertialSensorConfig config;
  config.gyroscope = {};
  config.accelerometer = {};
  InertialSensor sensor(config, kRate, 1);
  ImuSample sample{5, {0.1, 0.2, 0.3}, {1, 2, 9.81}};
  sensor.measure(sample);
  EXPECT_EQ(sample.angular_velocity, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(sample.specific_force, Eigen::Vector3d(1, 2, 9.81));
}

TEST(InertialSensorTest, ABiasChangesNoNoiseDraw) {
  InertialAxesConfig noise;
  noise.noise_density = 1e-3;
  InertialAxesConfig both = noise;
  both.initial_bias = 1;
  const std::vector<double> plain = readings(noise, 50);
  const std::vector<double> shifted = readings(both, 50);
  for (std::size_t i = 1; i < plain.size(); ++i) {
    EXPECT_NEAR(shifted[i] - plain[i], shifted[0] - plain[0], 1e-12);
  }
}

}  // namespace
}  // namespace vinebench::sim
