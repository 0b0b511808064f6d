// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/scenario.h"

#include <algorithm>

#include "core/config/yaml.h"
#include "core/util/error.h"
#include "harness/judge/occlusion.h"
#include "harness/systems/external_slam.h"

namespace vinebench {
namespace {

/// A file that stands in for a part of the scenario is looked for from where the user is.
std::string part_value(const std::string& value) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(value, ignored)) return value;
  return fmt::format("\"{}\"", std::filesystem::absolute(value).string());
}

/// What a robot knows of its own wheels.
MecanumWheels wheels_of(const RoverConfig& rover) {
  return {rover.wheel_radius, rover.half_track, rover.half_wheelbase};
}

template <class T>
void move_into(std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), from.begin(), from.end());
  from.clear();
}

}  // namespace

Override parse_override(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    fail("--set {}: expected KEY=VALUE, such as world.sun.elevation_deg=20", text);
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

ScenarioConfig load_scenario(const std::filesystem::path& file,
                             const std::vector<Override>& overrides) {
  YamlDocument document = YamlDocument::load(file);
  const std::vector<std::string> parts{"world", "rover"};
  document.inherit("base", parts);
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
  check_sensors(scenario.simulation.sensors, rig);
  if (const auto& blind = scenario.expectations.blind) find_cameras(rig, blind->cameras);
  if (const auto& external = scenario.slam.external) {
    check_external_slam(*external, rig);
    if (scenario.simulation.route.steering == Steering::kEstimate) {
      fail(
          "{}: route.steering: estimate: expected a SLAM system that answers at each frame; "
          "slam.external answers in the end",
          file.string());
    }
  }
  move_into(scenario.boxes, scenario.simulation.world.boxes);
  move_into(scenario.tags, scenario.simulation.world.tags);
  scenario.simulation.world.place();
  std::optional<MecanumWheels>& wheels = scenario.slam.dead_reckoning.wheels;
  if (!wheels) wheels = wheels_of(scenario.simulation.rover);
  return scenario;
}

}  // namespace vinebench
