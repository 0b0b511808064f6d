// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/render_report.h"

#include <fmt/format.h>

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

double number(const Json& value) {
  return value.get<double>();
}

std::string text(const Json& value) {
  return value.get<std::string>();
}

std::string camera_lines(const Json& cameras) {
  std::string table =
      fmt::format("  {:14}{:>12}{:>10}{:>10}\n", "camera", "pixels", "cpu ms", "wall ms");
  for (const Json& camera : cameras) {
    table += fmt::format("  {:14}{:>12}{:>10.1f}{:>10.1f}\n", text(camera.at("camera")),
                         text(camera.at("pixels")), number(camera.at("cpu_ms")),
                         number(camera.at("wall_ms")));
  }
  return table;
}

std::string frame_lines(const Json& world) {
  std::string line = fmt::format("  frame of {} cameras:", world.at("cameras").size());
  for (const auto& [threads, wall_ms] : world.at("frame_wall_ms").items()) {
    line += fmt::format(" {:.1f} ms wall with {} thread{},", number(wall_ms), threads,
                        threads == "1" ? "" : "s");
  }
  line += fmt::format(" x {:.2f}\n", number(world.at("scaling")));
  return line + fmt::format("  memory: {:.0f} MiB; built in {:.1f} s, uploaded in {:.1f} s\n",
                            number(world.at("memory_mib")), number(world.at("build_s")),
                            number(world.at("upload_s")));
}

std::string mujoco_lines(const Json& mujoco) {
  std::string table =
      fmt::format("  MuJoCo's own renderer, {}\n  {:14}{:>12}{:>10}{:>10}{:>10}{:>9}{:>11}{:>9}\n",
                  text(mujoco.at("platform")), "camera", "pixels", "cpu ms", "wall ms", "meshes",
                  "shadows", "triangles", "ratio");
  for (const Json& image : mujoco.at("images")) {
    table += fmt::format(
        "  {:14}{:>12}{:>10.1f}{:>10.1f}{:>10}{:>9}{:>11}{:>9.1f}\n", text(image.at("camera")),
        text(image.at("pixels")), number(image.at("cpu_ms")), number(image.at("wall_ms")),
        text(image.at("meshes")), image.at("shadows").get<bool>() ? "yes" : "no",
        image.at("triangles").get<std::int64_t>(), number(image.at("throughput_ratio")));
  }
  return table + "  (ratio: its CPU time by ours; no levels of detail, no cut-out textures)\n";
}

}  // namespace

std::string render_table(const Json& world) {
  std::string table = fmt::format("{}: {} rows, {} plants\n", text(world.at("name")),
                                  world.at("rows").get<int>(), world.at("plants").get<int>());
  table += camera_lines(world.at("cameras")) + frame_lines(world);
  if (world.contains("mujoco")) table += mujoco_lines(world.at("mujoco"));
  return table;
}

}  // namespace vinebench::harness
