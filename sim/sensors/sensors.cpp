// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/sensors.h"

#include "core/util/error.h"

namespace vinebench::sim {

namespace {

void check_names(const SensorsConfig& config, const Rig& rig,
                 std::vector<std::string>& violations) {
  const auto check = [&](const std::string& place, const std::string& camera) {
    if (rig.find_camera(camera) >= 0) return;
    violations.push_back(
        fmt::format("sensors.{}: rig '{}' has no camera named '{}'", place, rig.name, camera));
  };
  const auto check_scope = [&](const std::string& place, const FaultScope& scope) {
    for (const std::string& camera : scope.cameras) check(place + ".cameras", camera);
  };
  for (std::size_t i = 0; i < config.camera.dirt.size(); ++i) {
    check_scope(fmt::format("camera.dirt.{}", i), config.camera.dirt[i].scope);
  }
  for (std::size_t i = 0; i < config.camera.leaves.size(); ++i) {
    check_scope(fmt::format("camera.leaves.{}", i), config.camera.leaves[i].scope);
  }
  for (std::size_t i = 0; i < config.drops.bursts.size(); ++i) {
    check_scope(fmt::format("drops.bursts.{}", i), config.drops.bursts[i]);
  }
  for (std::size_t i = 0; i < config.timing.triggers.size(); ++i) {
    check(fmt::format("timing.triggers.{}", i), config.timing.triggers[i].camera);
  }
  for (std::size_t i = 0; i < config.calibration.cameras.size(); ++i) {
    check(fmt::format("calibration.cameras.{}", i), config.calibration.cameras[i].name);
  }
}

}  // namespace

SensorsConfig perfect_sensors() {
  SensorsConfig config;
  config.camera.exposure.time = config.camera.exposure.reference_time;
  config.camera.point_spread = 0;
  config.camera.noise.enabled = false;
  config.inertial.gyroscope = {};
  config.inertial.accelerometer = {};
  config.wheels.counts_per_turn = 0;
  return config;
}

void check_sensors(const SensorsConfig& config, const Rig& rig) {
  std::vector<std::string> violations;
  const double taken = config.camera.exposure.longest() + config.camera.readout_time;
  if (!(taken * rig.rate_hz <= 1)) {
    violations.push_back(
        fmt::format("sensors.camera: exposure and readout take up to {} s, expected at most the {} "
                    "s between two frames of rig '{}'",
                    taken, 1 / rig.rate_hz, rig.name));
  }
  check_names(config, rig, violations);
  throw_violations(violations);
}

}  // namespace vinebench::sim
