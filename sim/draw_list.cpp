// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/draw_list.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vinebench {
namespace {

struct Visible {
  int shell = 0;  // things in nearer shells are drawn first
  int model = 0;
  int level = 0;
  int order = 0;
  double distance = 0;
  InstanceMatrix cam_from_model;

  auto batch_key() const { return std::tie(shell, model, level, order); }
};

/// Shells grow with the distance: few batches far away, a good order nearby.
int shell_of(double distance) {
  return static_cast<int>(std::floor(8 * std::log2(1 + distance)));
}

int level_of(const GpuModel& model, double distance, double lod_scale) {
  for (std::size_t i = 0; i < model.levels.size(); ++i) {
    if (distance < model.levels[i].until * lod_scale) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

DrawList make_draw_list(const GpuScene& scene, const PinholeCamera& camera, const Pose& T_world_cam,
                        double lod_scale) {
  const Frustum frustum(camera);
  const Eigen::Matrix4d cam_from_world = T_world_cam.inverse().matrix();
  std::vector<Visible> visible;
  for (const Instance& instance : scene.instances) {
    const GpuModel& model = scene.models[static_cast<std::size_t>(instance.model)];
    const Eigen::Matrix4d cam_from_model = cam_from_world * world_from_model(instance);
    if (model.bounds.isEmpty() || !frustum.may_see(model.bounds, cam_from_model)) continue;
    const Eigen::Vector3d eye =
        instance.T_world_model.inverse() * T_world_cam.translation / instance.scale;
    const Eigen::AlignedBox3d bounds = model.bounds.cast<double>();
    const double distance = bounds.exteriorDistance(eye) * instance.scale;
    const int level = level_of(model, distance, lod_scale);
    if (level < 0) continue;
    visible.push_back({shell_of(distance), instance.model, level, draw_order(eye - bounds.center()),
                       distance, cam_from_model.topRows<3>().cast<float>()});
  }
  std::stable_sort(visible.begin(), visible.end(), [](const Visible& a, const Visible& b) {
    return a.batch_key() < b.batch_key();
  });
  DrawList list;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const Visible& v = visible[i];
    if (i == 0 || v.batch_key() != visible[i - 1].batch_key()) {
      list.batches.push_back({v.model, v.level, v.order, i, 0});
    }
    ++list.batches.back().count;
    list.cam_from_model.push_back(v.cam_from_model);
  }
  return list;
}

}  // namespace vinebench
