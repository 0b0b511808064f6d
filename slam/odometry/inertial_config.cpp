// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/inertial_config.h"

namespace vinebench::slam {
namespace {

InertialNoise::Axes axes_noise(const InertialAxesConfig& config, const ImuNoise::Axes& of_rig,
                               double usual_bias) {
  return {config.noise_density.value_or(of_rig.noise_density),
          config.bias_random_walk.value_or(of_rig.bias_random_walk),
          config.bias.value_or(usual_bias)};
}

}  // namespace

std::optional<InertialNoise> inertial_noise(const std::optional<InertialConfig>& config,
                                            const std::optional<ImuNoise>& of_rig) {
  if (!config) return std::nullopt;
  const InertialNoise usual;
  const auto usual_of = [](const InertialNoise::Axes& axes) {
    return ImuNoise::Axes{axes.noise_density, axes.bias_random_walk};
  };
  const ImuNoise told =
      of_rig.value_or(ImuNoise{usual_of(usual.gyroscope), usual_of(usual.accelerometer)});
  return InertialNoise{
      axes_noise(config->gyroscope, told.gyroscope, usual.gyroscope.bias),
      axes_noise(config->accelerometer, told.accelerometer, usual.accelerometer.bias)};
}

}  // namespace vinebench::slam
