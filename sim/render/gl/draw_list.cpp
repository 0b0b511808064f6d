// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/draw_list.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vinebench::sim {
namespace {

struct Visible {
  int shell = 0;
  int model = 0;
  int level = 0;
  int order = 0;
  bool shaded = false;
  bool open = false;
  double distance = 0;  ///< m
  InstanceRow row;

  auto batch_key() const { return std::tie(shell, model, level, order, shaded, open); }
};

/// Shells grow with the distance: few batches far away, a good order nearby. Small objects occlude
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

/// Culling of instances for a camera.
class View {
 public:
  View(const GpuScene& scene, const PinholeCamera& camera, const Pose& T_world_cam,
       double lod_scale, const MovingShadow* shadow)
      : scene_(scene),
        frustum_(camera),
        camera_(T_world_cam.translation),
        cam_from_world_(T_world_cam.inverse().matrix()),
        nearer_(kLevelFocalLength / (lod_scale * std::max(camera.fx, camera.fy))),
        shadow_(shadow) {}

  /// Adds what moves if its hull may be in view.
  void add(const Mover& mover) {
    const Eigen::Affine3d cam_from_model(cam_from_world_ * mover.placed.world_from_model);
    std::vector<Eigen::Vector3d> hull;
    hull.reserve(mover.hull->size());
    for (const Eigen::Vector3d& point : *mover.hull) hull.push_back(cam_from_model * point);
    if (frustum_.may_see(hull)) add(mover.placed, mover.index);
  }

  /// Adds the instance if it may be in view.
  void add(const GpuInstance& instance, std::size_t index) {
    const GpuModel& model = scene_.models[static_cast<std::size_t>(instance.model)];
    const Eigen::Vector3d centre = (cam_from_world_ * instance.centre.homogeneous()).head<3>();
    if (model.bounds.isEmpty() || !frustum_.may_see(centre, instance.radius)) return;
    const double at_least = std::max(0.0, centre.norm() - instance.radius);
    if (level_of(model, at_least * nearer_) < 0) return;
    const Eigen::Matrix4d cam_from_model = cam_from_world_ * instance.world_from_model;
    if (!frustum_.may_see(model.bounds, cam_from_model)) return;
    const Eigen::Vector3d camera = (instance.model_from_world * camera_.homogeneous()).head<3>();
    const Eigen::AlignedBox3d bounds = model.bounds.cast<double>();
    const double distance = bounds.exteriorDistance(camera) * instance.scale;
    const int level = level_of(model, distance * nearer_);
    if (level < 0) return;
    Visible& v = visible_.emplace_back();
    const double inside = model.hollow - (camera - bounds.center()).head<2>().norm();
    v.shell = shell_of(std::max(distance, inside * instance.scale), model.ordered && level < 4);
    v.model = instance.model;
    v.level = level;
    v.order = model.ordered ? draw_order(camera - bounds.center()) : 0;
    v.shaded = shadow_ != nullptr && shadow_->may_shade(instance.centre, instance.radius);
    v.open = instance.open;
    v.distance = distance;
    v.row = {cam_from_model.topRows<3>().cast<float>(), static_cast<std::uint32_t>(index + 1)};
  }

  DrawList list() {
    std::stable_sort(visible_.begin(), visible_.end(), [](const Visible& a, const Visible& b) {
      return std::pair(a.batch_key(), a.distance) < std::pair(b.batch_key(), b.distance);
    });
    DrawList list;
    for (std::size_t i = 0; i < visible_.size(); ++i) {
      const Visible& v = visible_[i];
      if (i == 0 || v.batch_key() != visible_[i - 1].batch_key()) {
        list.batches.push_back({v.shell, v.model, v.level, v.order, v.shaded, v.open, i, 0});
      }
      ++list.batches.back().count;
      list.rows.push_back(v.row);
    }
    return list;
  }

 private:
  const GpuScene& scene_;
  Frustum frustum_;
  Eigen::Vector3d camera_;
  Eigen::Matrix4d cam_from_world_;
  double nearer_;  ///< scales distances of levels from kLevelFocalLength
  const MovingShadow* shadow_;
  std::vector<Visible> visible_;
};

}  // namespace

DrawList make_draw_list(const GpuScene& scene, const PinholeCamera& camera, const Pose& T_world_cam,
                        double lod_scale, const MoversInView& moving) {
  View view(scene, camera, T_world_cam, lod_scale, moving.shadow);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (!scene.instances[i].moves) view.add(scene.instances[i], i);
  }
  for (const Mover& mover : moving.movers) view.add(mover);
  return view.list();
}

}  // namespace vinebench::sim
