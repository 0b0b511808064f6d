// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/scenario.h"

#include <algorithm>
#include <utility>

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "core/util/error.h"
#include "harness/experiment/known_discrepancies.h"
#include "harness/judge/bounds.h"
#include "harness/judge/occlusion.h"
#include "harness/systems/external_slam.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

/// A file given on the command line for a part of the scenario is relative to the working
/// directory.
std::string part_value(const std::string& value) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(value, ignored)) return value;
  return fmt::format("\"{}\"", std::filesystem::absolute(value).string());
}

/// The nominal wheel geometry.
slam::MecanumWheels wheels_of(const sim::RoverConfig& rover) {
  return {rover.wheel_radius, rover.half_track, rover.half_wheelbase};
}

/// The scenario's occluders and tags beside its world's own.
void furnish_world(ScenarioConfig& scenario) {
  sim::WorldConfig& world = scenario.simulation.world;
  sim::append_occluders(world.occluders, std::exchange(scenario.occluders, {}));
  world.tags.insert(world.tags.end(), scenario.tags.begin(), scenario.tags.end());
  scenario.tags.clear();
  sim::check_layout(world);
}

/// One occlusion is measured in a run.
void check_occlusion(const ScenarioConfig& scenario, const Rig& rig,
                     const std::filesystem::path& file) {
  int asked = 0;
  for (const Expectations* part : {&scenario.expectations, &scenario.goal}) {
    if (!part->blind) continue;
    find_cameras(rig, part->blind->cameras);
    ++asked;
  }
  if (asked > 1)
    fail("{}: blind: expected in expectations or in goal, found in both", file.string());
  if (scenario.guard && scenario.guard->bounds.blind) {
    fail("{}: guard.blind: expected in expectations or in goal", file.string());
  }
}

/// What is reached now is of a goal.
void check_now(const ScenarioConfig& scenario, const std::filesystem::path& file) {
  if (scenario.now.blind) {
    fail("{}: now.blind: expected in expectations or in goal", file.string());
  }
  for (const Bound& bound : bounds()) {
    if (bound.asked(scenario.now) && !bound.asked(scenario.goal)) {
      fail("{}: now.{}: expected only beside goal.{}", file.string(), bound.key, bound.key);
    }
  }
}

}  // namespace

ScenarioConfig load_scenario(const std::filesystem::path& file,
                             const std::vector<Override>& overrides) {
  YamlDocument document = YamlDocument::load(file);
  const std::vector<std::string> parts{"world", "rover"};
  document.inherit("base", parts, {"guard"});
  const auto is_part = [&](const Override& o) { return std::ranges::count(parts, o.first) > 0; };
  for (const Override& o : overrides) {
    if (is_part(o)) document.set(o.first, part_value(o.second));
  }
  for (const std::string& part : parts) document.include(part);
  for (const Override& o : overrides) {
    if (!is_part(o)) document.set(o.first, o.second);
  }
  auto scenario = document.read<ScenarioConfig>();
  const Rig rig = load_rig(scenario.simulation.rover.rig);
  sim::check_sensors(scenario.simulation.sensors, rig);
  check_occlusion(scenario, rig, file);
  check_now(scenario, file);
  if (const auto& external = scenario.slam.external) {
    check_external_slam(*external, rig);
    if (scenario.simulation.route.steering == sim::Steering::kEstimate) {
      fail(
          "{}: route.steering: estimate: expected a SLAM system with live estimates; "
          "slam.external has none",
          file.string());
    }
  }
  if (scenario.earlier_visit && !scenario.slam.is_core()) {
    fail("{}: earlier_visit: requires the built-in SLAM core, whose map is kept", file.string());
  }
  furnish_world(scenario);
  std::optional<slam::MecanumWheels>& wheels = scenario.slam.dead_reckoning.wheels;
  if (!wheels) wheels = wheels_of(scenario.simulation.rover);
  return scenario;
}

std::vector<RegisteredTag> registered_tags(const ScenarioConfig& scenario) {
  return sim::registered_tags(scenario.simulation.world, static_cast<std::uint64_t>(scenario.seed));
}

Trial trial_of(const ScenarioConfig& scenario) {
  Trial trial;
  trial.name = scenario.name;
  trial.seed = scenario.seed;
  trial.expectations = scenario.expectations;
  trial.goal = scenario.goal;
  const bool ours = scenario.slam.is_core();
  if (scenario.guard && ours) trial.guard = scenario.guard->bounds;
  if (ours) trial.now = scenario.now;
  trial.site = sim::site_of(scenario.simulation.world);
  const auto& waypoints = scenario.simulation.route.waypoints;
  if (!waypoints.empty()) trial.route_end = waypoints.back().position;
  trial.miscalibrated = scenario.simulation.sensors.calibration.any();
  if (const auto& file = scenario.simulation.rover.rig; !file.empty()) {
    const Rig rig = load_rig(file);
    const ToldRobot told{rig, registered_tags(scenario), scenario.slam.dead_reckoning.wheels};
    trial.discrepancies = known_discrepancies(scenario.simulation,
                                              static_cast<std::uint64_t>(scenario.seed), rig, told);
  }
  return trial;
}

std::string resolved_settings(ScenarioConfig scenario) {
  scenario.simulation.world = sim::written_out(scenario.simulation.world);
  return format_yaml(scenario);
}

RecordingNotes notes_of(const ScenarioConfig& scenario) {
  RecordingNotes notes;
  notes.rig = YamlDocument::load(scenario.simulation.rover.rig).read<RigConfig>();
  notes.tags = registered_tags(scenario);
  notes.slam = scenario.slam;
  notes.imu_rate_hz = scenario.simulation.rover.imu_rate_hz;
  const sim::InertialSensorConfig& imu = scenario.simulation.sensors.inertial;
  notes.imu = {{imu.gyroscope.noise_density, imu.gyroscope.bias_random_walk},
               {imu.accelerometer.noise_density, imu.accelerometer.bias_random_walk}};
  notes.scenario = scenario.name;
  notes.world = scenario.simulation.world.name;
  notes.seed = scenario.seed;
  notes.settings = resolved_settings(scenario);
  notes.world_tags = sim::world_tags(scenario.simulation.world);
  notes.true_cameras = sim::true_rig(notes.rig.make(), scenario.simulation.sensors.calibration,
                                     static_cast<std::uint64_t>(scenario.seed))
                           .cameras;
  return notes;
}

}  // namespace vinebench::harness
