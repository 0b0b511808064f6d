// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/view_export.h"

#include <algorithm>
#include <map>
#include <utility>

namespace vinebench::sim {
namespace {

/// m from the camera to the nearest point of its box.
double distance_to_box(const Instance& instance, const Model& model,
                       const Eigen::Vector3d& camera) {
  const Eigen::Vector3d there = instance.T_world_model.inverse() * camera / instance.scale;
  return model.bounds.cast<double>().exteriorDistance(there) * instance.scale;
}

/// The first whose distance is larger; -1 beyond the last.
int level_index(const Model& model, double distance) {
  const auto level = std::ranges::find_if(
      model.levels, [&](const LevelOfDetail& one) { return distance < one.until; });
  return level == model.levels.end() ? -1 : static_cast<int>(level - model.levels.begin());
}

bool is_ground(const Scene& scene, const Model& model) {
  return std::ranges::any_of(model.levels.front().primitives, [&](const Primitive& primitive) {
    return scene.materials[static_cast<std::size_t>(primitive.material)].terrain;
  });
}

/// Four sides, open at both ends.
void add_prism(const Wire& wire, Primitive& primitive) {
  const Eigen::Vector3f along = (wire.to - wire.from).normalized();
  const Eigen::Vector3f across = along.unitOrthogonal();
  const Eigen::Vector3f third = along.cross(across);
  const auto first = static_cast<std::uint32_t>(primitive.vertices.size());
  for (const Eigen::Vector3f& normal :
       {across, third, Eigen::Vector3f(-across), Eigen::Vector3f(-third)}) {
    primitive.vertices.push_back({wire.from + wire.radius * normal, normal});
    primitive.vertices.push_back({wire.to + wire.radius * normal, normal});
  }
  for (std::uint32_t side = 0; side < 4; ++side) {
    const std::uint32_t here = first + 2 * side;
    const std::uint32_t next = first + 2 * ((side + 1) % 4);
    for (const std::uint32_t corner : {here, next, here + 1, next, next + 1, here + 1}) {
      primitive.indices.push_back(corner);
    }
  }
}

}  // namespace

std::vector<PlacedMesh> meshes_in_reach(const Scene& scene, const ExportedView& view) {
  const double nearer =
      kLevelFocalLength / (view.lod_scale * std::max(view.camera.fx, view.camera.fy));
  std::vector<PlacedMesh> placed;
  for (const Instance& instance : scene.instances) {
    const Model& model = scene.models[static_cast<std::size_t>(instance.model)];
    if (model.levels.empty() || model.bounds.isEmpty()) continue;
    const double distance = distance_to_box(instance, model, view.T_world_cam.translation);
    const int level = level_index(model, nearer * distance);
    if (level < 0 || (distance > view.reach && !is_ground(scene, model))) continue;
    placed.push_back({instance.model, level, instance.T_world_model, instance.scale});
  }
  return placed;
}

void add_wires(Scene& scene, const ExportedView& view, std::vector<PlacedMesh>& placed) {
  const Eigen::Vector3f camera = view.T_world_cam.translation.cast<float>();
  std::map<int, Primitive> by_material;
  for (const Wire& wire : scene.wires) {
    if ((0.5f * (wire.from + wire.to) - camera).norm() > view.reach) continue;
    Primitive& primitive = by_material[wire.material];
    primitive.material = wire.material;
    add_prism(wire, primitive);
  }
  if (by_material.empty()) return;
  Model model;
  model.name = "wires";
  model.levels.emplace_back();
  for (auto& [material, primitive] : by_material) {
    for (const Vertex& vertex : primitive.vertices) model.bounds.extend(vertex.position);
    model.levels[0].primitives.push_back(std::move(primitive));
  }
  placed.push_back({static_cast<int>(scene.models.size()), 0, Pose(), 1});
  scene.models.push_back(std::move(model));
}

}  // namespace vinebench::sim
