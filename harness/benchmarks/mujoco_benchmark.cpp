// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/mujoco_benchmark.h"

#include <algorithm>
#include <array>

#include "harness/benchmarks/measurement.h"
#include "harness/datasets/files/image_file.h"
#include "sim/render/mujoco/mujoco_renderer.h"

namespace vinebench::harness {
namespace {

struct Variant {
  const char* meshes;
  const char* file;
  double distance;  ///< m
  bool shadows;
};

constexpr std::array<Variant, 3> kVariants{{{"finest", "mujoco-finest", 0, false},
                                            {"at 2 m", "mujoco-2m", 2, false},
                                            {"finest", "mujoco-shadows", 0, true}}};

/// The first camera of each size.
std::vector<RigCamera> one_of_each_size(const Rig& rig) {
  std::vector<RigCamera> chosen;
  for (const RigCamera& camera : rig.cameras) {
    const auto same_size = [&](const RigCamera& other) {
      return other.model.width == camera.model.width && other.model.height == camera.model.height;
    };
    if (std::ranges::none_of(chosen, same_size)) chosen.push_back(camera);
  }
  return chosen;
}

nlohmann::ordered_json measure_variant(const RenderBenchmark& benchmark, const sim::Scene& scene,
                                       const RigCamera& camera, const Variant& variant) {
  sim::MujocoRendererConfig config;
  config.level_distance = variant.distance * sim::kLevelFocalLength / camera.model.fx;
  config.shadows = variant.shadows;
  sim::MujocoRenderer renderer(scene, config);
  const Pose& first = benchmark.route.front();
  const cv::Mat image =
      renderer.render(camera.model, first * camera.T_body_cam, {}).rgb;  // warm up
  if (!benchmark.images.empty()) {
    write_image(benchmark.images / fmt::format("{}-{}.png", camera.name, variant.file), image);
  }
  std::vector<Timing> timings;
  for (const Pose& T_world_body : benchmark.route) {
    timings.push_back(
        measure([&] { renderer.render(camera.model, T_world_body * camera.T_body_cam, {}); }));
  }
  const Timing typical = median(timings);
  return {{"camera", camera.name},
          {"pixels", fmt::format("{} x {}", camera.model.width, camera.model.height)},
          {"meshes", variant.meshes},
          {"shadows", variant.shadows},
          {"triangles", renderer.triangles()},
          {"cpu_ms", rounded(typical.cpu_ms)},
          {"wall_ms", rounded(typical.wall_ms)}};
}

}  // namespace

nlohmann::ordered_json measure_mujoco(const RenderBenchmark& benchmark) {
  const sim::Scene scene = sim::build_scene(benchmark.world, benchmark.seed, benchmark.plant_cache);
  nlohmann::ordered_json result{{"platform", sim::MujocoRenderer::platform()}};
  for (const RigCamera& camera : one_of_each_size(benchmark.rig)) {
    for (const Variant& variant : kVariants) {
      result["images"].push_back(measure_variant(benchmark, scene, camera, variant));
    }
  }
  return result;
}

void compare_with_mujoco(nlohmann::ordered_json& mujoco, const nlohmann::ordered_json& cameras) {
  for (nlohmann::ordered_json& image : mujoco["images"]) {
    for (const nlohmann::ordered_json& camera : cameras) {
      if (camera["camera"] != image["camera"]) continue;
      image["throughput_ratio"] =
          rounded(image["cpu_ms"].get<double>() / camera["cpu_ms"].get<double>());
    }
  }
}

}  // namespace vinebench::harness
