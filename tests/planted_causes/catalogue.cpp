// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"
#include "tests/planted_causes/planted_cause.h"

namespace vinebench::planted {
namespace {

using harness::Cause;
using harness::ScenarioConfig;

constexpr int kMild = 2;                          // distractions in a drive
constexpr double kTurn = 60 * kRadiansPerDegree;  // rad, the heading in the end

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
/// cameras, which then are 0.15 m ahead of x = 1.6 and look 60 degrees to the left.
void block_the_view(ScenarioConfig& scenario, RandomSequence& draw) {
  const Eigen::Vector2d ahead(std::cos(kTurn), std::sin(kTurn));
  const Eigen::Vector2d middle =
      Eigen::Vector2d(1.6, 0) + (0.15 + draw.uniform(0.12, 0.22) + 0.1) * ahead;
  sim::Occluder wall = box(middle.x(), middle.y(), {0.2, 0.9, 1.1});
  wall.yaw_deg = kTurn / kRadiansPerDegree;
  world(scenario).occluders.push_back(wall);
}

/// A printed box is carried ahead of the rover, to one side in the end.
void carry_a_box(ScenarioConfig& scenario, RandomSequence& draw) {
  sim::Occluder box;
  box.size = {0.3, draw.uniform(0.7, 0.9), 0.9};
  box.printed = true;
  const double ahead = draw.uniform(0.8, 0.95);
  sim::OccluderPath path;
  path.speed = 0.5;
  path.waypoints = {{.position = {ahead, 0}},
                    {.position = {1.2 + ahead, 0}},
                    {.position = {1.7 + ahead, draw.uniform(0.4, 0.6)}}};
  box.path = path;
  world(scenario).occluders.push_back(box);
}

void add_world_causes(std::vector<PlantedCause>& list) {
  list.push_back({"occluder-carton",
                  block_the_view,
                  [](ScenarioConfig& scenario) {
                    world(scenario).occluders.push_back(box(4.6, 1.6, {0.4, 0.4, 0.4}));
                  },
                  {Cause::kOcclusion}});
  list.push_back({"moving-carton", carry_a_box, {}, {Cause::kMovingObjects, Cause::kOcclusion}});
  list.push_back({"wind", {}, [](ScenarioConfig& scenario) { world(scenario).wind.speed = 1; }});
}

/// Overexposed 50 to 100 times, or underexposed 5000 times and more: within these, this estimator
/// finds what it needs.
void expose_badly(ScenarioConfig& scenario, RandomSequence& draw) {
  sim::ExposureConfig& exposure = camera(scenario).exposure;
  if (draw.uniform() < 0.5) {
    exposure.gain_db = -20;
    exposure.time = exposure.reference_time * draw.uniform(0.0008, 0.002);
  } else {
    exposure.gain_db = draw.uniform(34, 40);
  }
}

void add_exposure_causes(std::vector<PlantedCause>& list) {
  list.push_back({"noise", [](ScenarioConfig& scenario, RandomSequence& draw) {
                    camera(scenario).noise.read_noise = draw.uniform(350, 420);
                  }});
  list.push_back({"exposure",
                  expose_badly,
                  [](ScenarioConfig& scenario) { camera(scenario).exposure.gain_db = 0.5; },
                  {Cause::kExposure}});
  list.push_back({"blur",
                  [](ScenarioConfig& scenario, RandomSequence& draw) {
                    sim::CameraSensorConfig& sensor = camera(scenario);
                    sensor.exposure.time = draw.uniform(0.062, 0.066);
                    sensor.exposure.reference_time *= *sensor.exposure.time / sim::kNominalTime;
                    sensor.blur_subframes = 3;
                  },
                  {},
                  {Cause::kMotionBlur}});
  list.push_back({"rolling-shutter",
                  [](ScenarioConfig& scenario, RandomSequence& draw) {
                    sim::CameraSensorConfig& sensor = camera(scenario);
                    // Exposure and readout fit between two frames of rig.yaml.
                    sensor.readout_time =
                        std::min(draw.uniform(0.044, 0.052), 1.0 / 15 - sensor.exposure.longest());
                    sensor.readout_bands = 4;
                  },
                  {},
                  {Cause::kRollingShutter}});
}

void add_glass_causes(std::vector<PlantedCause>& list) {
  list.push_back({"dirt",
                  [](ScenarioConfig& scenario, RandomSequence& draw) {
                    sim::LensDirtConfig dirt;
                    dirt.count = 60 + draw.below(40);
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
                    leaf.size = draw.uniform(1.4, 1.8);
                    leaf.position = {draw.uniform(0.4, 0.6), draw.uniform(0.4, 0.6)};
                    leaf.angle_deg = draw.uniform(-180, 180);
                    leaf.scope.from = 1.8;
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
       },
       {Cause::kTimeOffset}});
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
                    const double from = draw.uniform(2.0, 2.3);
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
    add_exposure_causes(list);
    add_glass_causes(list);
    add_sensor_causes(list);
    return list;
  }();
  return kList;
}

std::vector<std::string> Case::names() const {
  std::vector<std::string> names;
  for (const std::size_t cause : causes) names.push_back(all_causes()[cause].name);
  return names;
}

ScenarioConfig planted_drive(const Case& one, const std::vector<std::size_t>& planted) {
  ScenarioConfig scenario =
      harness::load_scenario(VINEBENCH_SOURCE_DIR "/tests/planted_causes/drive.yaml");
  scenario.seed = one.seed;
  const auto seed = static_cast<std::uint64_t>(one.seed);
  for (const std::size_t cause : planted) {
    RandomSequence draw(RandomStream(seed, "planted " + all_causes()[cause].name));
    all_causes()[cause].plant(scenario, draw);
  }
  std::vector<std::size_t> mild;
  for (std::size_t i = 0; i < all_causes().size(); ++i) {
    if (all_causes()[i].plant_mild && std::ranges::count(one.causes, i) == 0) mild.push_back(i);
  }
  RandomSequence draw(RandomStream(seed, "mild"));
  for (int i = 0; i < kMild && !mild.empty(); ++i) {
    const auto chosen = mild.begin() + draw.below(static_cast<int>(mild.size()));
    all_causes()[*chosen].plant_mild(scenario);
    mild.erase(chosen);
  }
  return scenario;
}

}  // namespace vinebench::planted
