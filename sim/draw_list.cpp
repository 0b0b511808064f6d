// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/draw_list.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vinebench {
namespace {

struct Visible {
  int shell = 0;
  int model = 0;
  int level = 0;
  int order = 0;
  InstanceRow row;

  auto batch_key() const { return std::tie(shell, model, level, order); }
};

/// Shells grow with the distance: few batches far away, a good order nearby. Small things hide
/// little, so their shells are wide.
int shell_of(double distance, bool ordered) {
  const double octave = std::log2(1 + distance);
  return ordered ? static_cast<int>(6 * octave) : 6 * static_cast<int>(octave) + 5;
}

int level_of(const GpuModel& model, double distance) {
  for (std::size_t i = 0; i < model.levels.size(); ++i) {
    if (distance < model.levels[i].until) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

DrawList make_draw_list(const GpuScene& scene, const PinholeCamera& camera, const Pose& T_world_cam,
                        double lod_scale) {
  const Frustum frustum(camera);
  const Eigen::Matrix4d cam_from_world = T_world_cam.inverse().matrix();
  const double nearer = kLevelFocalLength / (lod_scale * std::max(camera.fx, camera.fy));
  std::vector<Visible> visible;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const GpuInstance& instance = scene.instances[i];
    const GpuModel& model = scene.models[static_cast<std::size_t>(instance.model)];
    const Eigen::Vector3d centre = (cam_from_world * instance.centre.homogeneous()).head<3>();
    if (model.bounds.isEmpty() || !frustum.may_see(centre, instance.radius)) continue;
    const double at_least = std::max(0.0, centre.norm() - instance.radius);
    if (level_of(model, at_least * nearer) < 0) continue;
    const Eigen::Matrix4d cam_from_model = cam_from_world * instance.world_from_model;
    if (!frustum.may_see(model.bounds, cam_from_model)) continue;
    const Eigen::Vector3d eye =
        (instance.model_from_world * T_world_cam.translation.homogeneous()).head<3>();
    const Eigen::AlignedBox3d bounds = model.bounds.cast<double>();
    const double distance = bounds.exteriorDistance(eye) * instance.scale;
    const int level = level_of(model, distance * nearer);
    if (level < 0) continue;
    Visible& v = visible.emplace_back();
    v.shell = shell_of(distance, model.ordered);
    v.model = instance.model;
    v.level = level;
    v.order = model.ordered ? draw_order(eye - bounds.center()) : 0;
    v.row = {cam_from_model.topRows<3>().cast<float>(), static_cast<std::uint32_t>(i + 1)};
  }
  std::stable_sort(visible.begin(), visible.end(), [](const Visible& a, const Visible& b) {
    return a.batch_key() < b.batch_key();
  });
  DrawList list;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const Visible& v = visible[i];
    if (i == 0 || v.batch_key() != visible[i - 1].batch_key()) {
      list.batches.push_back({v.shell, v.model, v.level, v.order, i, 0});
    }
    ++list.batches.back().count;
    list.rows.push_back(v.row);
  }
  return list;
}

}  // namespace vinebench
