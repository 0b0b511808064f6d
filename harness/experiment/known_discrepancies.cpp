// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/known_discrepancies.h"

#include <cmath>

#include "sim/sensors/calibration_error.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

constexpr double kLeastDelay = 1e-4;  // s
constexpr double kLeastPixels = 0.1;

double delay_of(const sim::FrameTimingConfig& timing, const std::string& camera) {
  for (const sim::FrameTimingConfig::Trigger& trigger : timing.triggers) {
    if (trigger.camera == camera) return trigger.delay;
  }
  return 0;
}

/// `speed` in m/s: that far things move meanwhile.
void add_timing(const sim::FrameTimingConfig& timing, const Rig& rig, double speed,
                std::vector<Discrepancy>& list) {
  const auto add = [&](const std::string& of, const char* what, double seconds, double focal) {
    if (std::abs(seconds) < kLeastDelay) return;
    list.push_back({of, what, 1000 * seconds, "ms", std::abs(seconds) * speed * focal});
  };
  std::vector<double> delays;
  for (const RigCamera& camera : rig.cameras) delays.push_back(delay_of(timing, camera.name));
  std::vector<char> done(rig.cameras.size(), 0);
  for (const StereoPair& pair : rig.stereo_pairs) {
    const auto left = static_cast<std::size_t>(pair.left);
    const auto right = static_cast<std::size_t>(pair.right);
    if (delays[left] != delays[right]) continue;
    done[left] = done[right] = 1;
    add(pair.name + " pair", "exposure", delays[left], rig.cameras[left].model.fx);
  }
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    if (!done[i]) add(rig.cameras[i].name, "exposure", delays[i], rig.cameras[i].model.fx);
  }
  const double focal = rig.cameras.front().model.fx;
  add("all cameras", "stamps", timing.stamp_offset, focal);
  if (timing.stamp_jitter >= kLeastDelay) {
    list.push_back({"all cameras", "stamps' jitter", 1000 * timing.stamp_jitter, "ms",
                    timing.stamp_jitter * speed * focal});
  }
}

/// An error of a share of the path moves what is seen 1 m away by that share after 1 m.
void add_wheels(const slam::MecanumWheels& told, const sim::RoverConfig& truth, double focal,
                std::vector<Discrepancy>& list) {
  const auto add = [&](const char* what, double size, double true_size) {
    const double share = size / true_size - 1;
    const double pixels = std::abs(share) * focal;
    if (pixels >= kLeastPixels) list.push_back({"wheels", what, 100 * share, "%", pixels});
  };
  add("radius", told.radius, truth.wheel_radius);
  add("track", told.half_track, truth.half_track);
  add("wheelbase", told.half_wheelbase, truth.half_wheelbase);
}

}  // namespace

std::vector<Discrepancy> known_discrepancies(const sim::SimulationConfig& simulation,
                                             std::uint64_t seed, const Rig& nominal,
                                             const ToldRobot& told) {
  const Rig truth = sim::true_rig(nominal, simulation.sensors.calibration, seed);
  std::vector<Discrepancy> list = rig_discrepancies(told.rig, truth);
  const int reader = truth.tag_cameras.empty() ? 0 : truth.tag_cameras.front();
  const double focal = truth.cameras[static_cast<std::size_t>(reader)].model.fx;
  const auto surveyed = tag_discrepancies(told.tags, sim::world_tags(simulation.world), focal);
  list.insert(list.end(), surveyed.begin(), surveyed.end());
  add_timing(simulation.sensors.timing, truth, simulation.route.speed, list);
  if (told.wheels) add_wheels(*told.wheels, simulation.rover, truth.cameras.front().model.fx, list);
  rank(list);
  return list;
}

}  // namespace vinebench::harness
