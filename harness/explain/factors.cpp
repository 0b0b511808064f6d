// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/factors.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "core/config/yaml_writer.h"
#include "core/geometry/angle.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

constexpr double kLowSun = 35;  // degrees above the horizon: below, it dazzles, dims and reddens
constexpr double kHighSun = 50;
constexpr int kFewTemplates = 3;
constexpr int kManyTemplates = 24;

sim::WorldConfig& world_of(Variant& variant) {
  return variant.scenario.simulation.world;
}

sim::SensorsConfig& sensors_of(Variant& variant) {
  return variant.scenario.simulation.sensors;
}

/// What a variant is, as text.
std::string identity(const Variant& variant) {
  return format_yaml(variant.scenario) + (variant.ideal_lenses ? "\nideal lenses" : "") +
         (variant.without_slip ? "\nwithout slip" : "");
}

/// One of the occluders of each class that stand, and one of those that move.
void add_occluders(std::vector<Factor>& list) {
  for (const bool moving : {false, true}) {
    for (std::size_t i = 0; i < kOccluderClasses; ++i) {
      const auto kind = static_cast<OccluderClass>(i);
      list.push_back({.name = (moving ? "moving-" : "occluder-") + name_of(kind),
                      .text = fmt::format("{} ({})", moving ? "moving objects" : "static occluders",
                                          name_of(kind)),
                      .remove = [kind, moving](Variant& variant) {
                        std::erase_if(world_of(variant).occluders, [&](const sim::Occluder& one) {
                          return class_of(one) == kind && one.path.has_value() == moving;
                        });
                      }});
    }
  }
}

/// Between the renderer's own exposure and the one that a vineyard at midday needs.
bool is_right(const sim::ExposureConfig& exposure) {
  if (exposure.automatic || exposure.gain_db != 0 || !exposure.time) return false;
  const double factor = *exposure.time / exposure.reference_time;
  return factor >= 1 && factor <= sim::kNominalTime / sim::ExposureConfig().reference_time;
}

void brighten(sim::ExposureConfig& exposure) {
  if (is_right(exposure)) return;
  exposure.automatic = false;
  exposure.gain_db = 0;
  if (!exposure.time) return;
  // Right for that time, so that blur stays.
  exposure.reference_time =
      *exposure.time * sim::ExposureConfig().reference_time / sim::kNominalTime;
}

void raise_sun(sim::WorldConfig& world) {
  const double elevation = world.sun.at
                               ? sim::sun_position(*world.sun.at).elevation / kRadiansPerDegree
                               : world.sun.elevation_deg;
  if (elevation >= kLowSun) return;
  if (world.sun.at) {
    world.sun.azimuth_deg = sim::sun_position(*world.sun.at).azimuth / kRadiansPerDegree;
    world.sun.at.reset();
  }
  world.sun.elevation_deg = kHighSun;
  world.sky.glare = 0;
}

void add_light_and_air(std::vector<Factor>& list) {
  list.push_back({.name = "sun",
                  .text = "low sun: its glare and its light",
                  .from_start = true,
                  .remove = [](Variant& variant) { raise_sun(world_of(variant)); }});
  list.push_back({.name = "haze", .text = "haze", .remove = [](Variant& variant) {
                    world_of(variant).sky.visibility.reset();
                  }});
  list.push_back({.name = "wind", .text = "wind in the plants", .remove = [](Variant& variant) {
                    world_of(variant).wind.speed = 0;
                  }});
}

void add_cameras(std::vector<Factor>& list) {
  const auto add = [&](const char* name, const char* text, auto remove) {
    list.push_back({.name = name, .text = text, .remove = [remove](Variant& variant) {
                      remove(sensors_of(variant).camera);
                    }});
  };
  using Camera = sim::CameraSensorConfig;
  add("noise", "noise of the images", [](Camera& camera) {
    camera.noise.enabled = false;
    camera.fixed_pattern = {};
  });
  add("blur", "motion blur", [](Camera& camera) { camera.blur_subframes = 1; });
  add("exposure", "exposure", [](Camera& camera) { brighten(camera.exposure); });
  add("rolling-shutter", "rolling shutter", [](Camera& camera) { camera.readout_time = 0; });
  add("vignetting", "vignetting", [](Camera& camera) { camera.vignetting = {}; });
  add("dirt", "dirt on the lenses", [](Camera& camera) { camera.dirt.clear(); });
  add("leaf", "leaves on the lenses", [](Camera& camera) { camera.leaves.clear(); });
  add("bayer", "colour filters", [](Camera& camera) { camera.bayer = sim::BayerPattern::kNone; });
  add("white-balance", "white balance", [](Camera& camera) { camera.white_balance = {}; });
  add("response", "colours and contrast", [](Camera& camera) { camera.response = {}; });
  add("jpeg", "compression", [](Camera& camera) { camera.jpeg.quality.reset(); });
}

void add_timing(std::vector<Factor>& list) {
  list.push_back({.name = "drops", .text = "dropped images", .remove = [](Variant& variant) {
                    sensors_of(variant).drops = {};
                  }});
  list.push_back({.name = "triggers",
                  .text = "cameras that expose at other times",
                  .remove = [](Variant& variant) { sensors_of(variant).timing.triggers.clear(); }});
  list.push_back({.name = "stamp-jitter",
                  .text = "jitter of the stamps",
                  .remove = [](Variant& variant) { sensors_of(variant).timing.stamp_jitter = 0; }});
  list.push_back({.name = "stamp-offset",
                  .text = "offset of the stamps",
                  .from_start = true,
                  .remove = [](Variant& variant) { sensors_of(variant).timing.stamp_offset = 0; }});
}

bool has_distortion(const Rig& rig) {
  return std::ranges::any_of(rig.cameras, [](const RigCamera& camera) {
    // An error of the lens is one of these four coefficients.
    return camera.model.lens == LensModel::kRadialTangential && camera.model.distortion[4] == 0 &&
           camera.model.has_distortion();
  });
}

/// Errors of the true lenses that undo the nominal distortion.
void undo_distortion(const Rig& rig, Variant& variant) {
  if (!has_distortion(rig)) return;
  variant.ideal_lenses = true;
  for (const RigCamera& camera : rig.cameras) {
    sim::CalibrationErrorConfig::Camera error{.name = camera.name};
    for (std::size_t i = 0; i < error.distortion.size(); ++i) {
      error.distortion[i] = -camera.model.distortion[i];
    }
    sensors_of(variant).calibration.cameras.push_back(std::move(error));
  }
}

void add_calibration(const Rig& rig, std::vector<Factor>& list) {
  list.push_back({.name = "calibration",
                  .text = "calibration error",
                  .from_start = true,
                  .remove = [](Variant& variant) {
                    // What ideal lenses need is no error.
                    if (!variant.ideal_lenses) sensors_of(variant).calibration.cameras.clear();
                    sim::CalibrationErrorConfig& error = sensors_of(variant).calibration;
                    error.position = error.rotation_deg = 0;
                    error.focal_px = error.principal_point_px = 0;
                  }});
  list.push_back({.name = "distortion",
                  .text = "distortion of the lenses",
                  .from_start = true,
                  .remove = [rig](Variant& variant) { undo_distortion(rig, variant); }});
}

void straighten_survey(sim::WorldConfig& world) {
  for (sim::WorldConfig::Tag& tag : world.tags) tag.survey_error = {};
  world.survey = {};
}

/// Of tags with the same number, the first registered one, else the first one, stays.
void remove_copies(sim::WorldConfig& world) {
  std::map<std::pair<std::string, int>, std::size_t> originals;
  for (std::size_t i = 0; i < world.tags.size(); ++i) {
    const auto [known, first] =
        originals.emplace(std::pair(world.tags[i].family, world.tags[i].id), i);
    if (!first && !world.tags[known->second].registered && world.tags[i].registered) {
      known->second = i;
    }
  }
  std::vector<sim::WorldConfig::Tag> kept;
  for (std::size_t i = 0; i < world.tags.size(); ++i) {
    const auto original = originals.find({world.tags[i].family, world.tags[i].id});
    if (original->second == i) kept.push_back(world.tags[i]);
  }
  world.tags = std::move(kept);
}

void vary_plants(sim::WorldConfig& world) {
  if (world.vines.meshes.empty() && world.vines.templates <= kFewTemplates) {
    world.vines.templates = kManyTemplates;
  }
}

void roll_wheels(Variant& variant) {
  const sim::FrameDropConfig& drops = sensors_of(variant).drops;
  const bool blind = drops.camera_rate > 0 || drops.frame_rate > 0 || !drops.bursts.empty();
  if (blind || !world_of(variant).terrain.flat()) variant.without_slip = true;
}

void add_world(std::vector<Factor>& list) {
  list.push_back({.name = "tag-survey",
                  .text = "survey errors of the tags",
                  .from_start = true,
                  .remove = [](Variant& variant) { straighten_survey(world_of(variant)); }});
  list.push_back({.name = "tag-copies",
                  .text = "several tags with one number",
                  .remove = [](Variant& variant) { remove_copies(world_of(variant)); }});
  list.push_back({.name = "repeated-plants",
                  .text = "plants that repeat",
                  .from_start = true,
                  .remove = [](Variant& variant) { vary_plants(world_of(variant)); }});
  list.push_back({.name = "ground",
                  .text = "uneven ground",
                  .from_start = true,
                  .remove = [](Variant& variant) { world_of(variant).terrain = {}; }});
  list.push_back({.name = "slip", .text = "slip of the wheels", .remove = roll_wheels});
}

}  // namespace

std::vector<Factor> factors_of(const ScenarioConfig& scenario) {
  std::vector<Factor> list;
  add_occluders(list);
  add_light_and_air(list);
  add_cameras(list);
  add_timing(list);
  add_calibration(load_rig(scenario.simulation.rover.rig), list);
  add_world(list);
  const Variant as_it_was{scenario};
  const std::string before = identity(as_it_was);
  std::erase_if(list, [&](const Factor& factor) {
    Variant variant = as_it_was;
    factor.remove(variant);
    return identity(variant) == before;
  });
  return list;
}

Variant with_other_noise(Variant variant, int number) {
  sim::PhotonTransferConfig& noise = sensors_of(variant).camera.noise;
  if (!noise.enabled) noise = {.enabled = true, .full_well = 1e7, .read_noise = 9000};
  noise.pattern = number;
  return variant;
}

}  // namespace vinebench::harness
