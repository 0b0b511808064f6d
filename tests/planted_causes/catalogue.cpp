// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tests/planted_causes/planted_cause.h"

namespace vinebench::planted {
namespace {

using harness::Cause;
using harness::ScenarioConfig;

constexpr int kMild = 2;  // distractions in a drive

sim::SensorsConfig& sensors(ScenarioConfig& scenario) {
  return scenario.simulation.sensors;
}

sim::CameraSensorConfig& camera(ScenarioConfig& scenario) {
  return sensors(scenario).camera;
}

sim::WorldConfig& world(ScenarioConfig& scenario) {
  return scenario.simulation.world;
}

sim::Occluder box(double x, double y, const Eigen::Vector3d& size) {
  sim::Occluder box;
  box.size = size;
  box.position = {x, y};
  return box;
}

/// A plain box that the rover drives up to: at last its face is 0.12 to 0.22 m ahead of the
/// cameras.
void block_the_view(ScenarioConfig& scenario, RandomSequence& draw) {
  const double end = 1.2 + 0.15 + draw.uniform(0.12, 0.22);  // m; the rover comes to x = 1.2
  world(scenario).occluders.push_back(box(end + 0.2, draw.uniform(-0.1, 0.1), {0.4, 0.9, 1.1}));
}

void add_world_causes(std::vector<PlantedCause>& list) {
  list.push_back({"occluder-carton",
                  block_the_view,
                  [](ScenarioConfig& scenario) {
                    world(scenario).occluders.push_back(box(3.6, 1.6, {0.4, 0.4, 0.4}));
                  },
                  {Cause::kOcclusion}});
  list.push_back({"wind", {}, [](ScenarioConfig& scenario) { world(scenario).wind.speed = 1; }});
}

void add_image_causes(std::vector<PlantedCause>& list) {
  list.push_back({"noise", [](ScenarioConfig& scenario, RandomSequence& draw) {
                    camera(scenario).noise.read_noise = draw.uniform(150, 400);
                  }});
  list.push_back({"exposure",
                  [](ScenarioConfig& scenario, RandomSequence& draw) {
                    const bool dark = draw.uniform() < 0.5;
                    camera(scenario).exposure.gain_db =
                        dark ? draw.uniform(-20, -18) : draw.uniform(15, 20);
                  },
                  [](ScenarioConfig& scenario) { camera(scenario).exposure.gain_db = 0.5; },
                  {Cause::kLittleTexture}});
  list.push_back({"dirt",
                  [](ScenarioConfig& scenario, RandomSequence& draw) {
                    sim::LensDirtConfig dirt;
                    dirt.count = 60 + draw.below(60);
                    dirt.radius_px = {5, draw.uniform(20, 30)};
                    dirt.opacity = 0.95;
                    dirt.blur_px = 3;
                    camera(scenario).dirt.push_back(dirt);
                  },
                  [](ScenarioConfig& scenario) {
                    sim::LensDirtConfig dirt;
                    dirt.count = 3;
                    dirt.radius_px = {4, 6};
                    dirt.opacity = 0.3;
                    camera(scenario).dirt.push_back(dirt);
                  }});
  list.push_back({"leaf", [](ScenarioConfig& scenario, RandomSequence& draw) {
                    sim::LensLeafConfig leaf;
                    leaf.size = draw.uniform(0.9, 1.4);
                    leaf.position = {draw.uniform(0.35, 0.65), draw.uniform(0.35, 0.65)};
                    leaf.angle_deg = draw.uniform(-180, 180);
                    leaf.scope.from = 1;
                    camera(scenario).leaves.push_back(leaf);
                  }});
}

void add_sensor_causes(std::vector<PlantedCause>& list) {
  list.push_back(
      {"triggers",
       [](ScenarioConfig& scenario, RandomSequence& draw) {
         const double sign = draw.uniform() < 0.5 ? -1 : 1;
         sensors(scenario).timing.triggers = {{"right", sign * draw.uniform(0.015, 0.035)}};
       },
       [](ScenarioConfig& scenario) {
         sensors(scenario).timing.triggers = {{"right", 0.0002}};
       }});
  list.push_back(
      {"calibration",
       [](ScenarioConfig& scenario, RandomSequence& draw) {
         const double sign = draw.uniform() < 0.5 ? -1 : 1;
         sim::CalibrationErrorConfig::Camera error;
         error.name = "right";
         error.position.x() = sign * draw.uniform(0.004, 0.01);
         sensors(scenario).calibration.cameras.push_back(error);
       },
       [](ScenarioConfig& scenario) { sensors(scenario).calibration.principal_point_px = 0.005; },
       {Cause::kCalibrationError}});
  list.push_back({"drops",
                  [](ScenarioConfig& scenario, RandomSequence& draw) {
                    const double from = draw.uniform(1.3, 1.6);
                    sim::FaultScope burst;
                    burst.from = from;
                    burst.until = from + draw.uniform(0.5, 1.0);
                    sensors(scenario).drops.bursts.push_back(burst);
                  },
                  {},
                  {Cause::kDroppedImages}});
}

}  // namespace

const std::vector<PlantedCause>& all_causes() {
  static const std::vector<PlantedCause> kList = [] {
    std::vector<PlantedCause> list;
    add_world_causes(list);
    add_image_causes(list);
    add_sensor_causes(list);
    return list;
  }();
  return kList;
}

ScenarioConfig planted_drive(const std::filesystem::path& file,
                             const std::vector<std::size_t>& causes, std::int64_t seed) {
  ScenarioConfig scenario = harness::load_scenario(file);
  scenario.seed = seed;
  std::vector<std::size_t> mild;
  for (std::size_t i = 0; i < all_causes().size(); ++i) {
    if (all_causes()[i].plant_mild && std::ranges::count(causes, i) == 0) mild.push_back(i);
  }
  std::string name;
  for (const std::size_t cause : causes) name += all_causes()[cause].name + " ";
  RandomSequence draw(RandomStream(static_cast<std::uint64_t>(seed), "planted " + name));
  for (const std::size_t cause : causes) all_causes()[cause].plant(scenario, draw);
  for (int i = 0; i < kMild && !mild.empty(); ++i) {
    const auto chosen = mild.begin() + draw.below(static_cast<int>(mild.size()));
    all_causes()[*chosen].plant_mild(scenario);
    mild.erase(chosen);
  }
  return scenario;
}

}  // namespace vinebench::planted
