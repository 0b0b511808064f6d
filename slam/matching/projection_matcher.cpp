// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/projection_matcher.h"

#include <algorithm>
#include <cmath>

#include "slam/frame/measurements.h"

namespace vinebench::slam {
namespace {

/// A leaf looks different from farther around than this.
constexpr double kMinViewCosine = 0.5;

/// Where and at what scale a landmark should be seen.
struct Prediction {
  Eigen::Vector2d pixel;
  double right_x = 0;
  int level = 0;
  bool visible = false;
};

Prediction predict(const Landmark& landmark, int v, const Pose& T_body_map, const EstimatorRig& rig,
                   double level_scale) {
  Prediction p;
  const StereoCameraModel& camera = rig.left_cameras[static_cast<std::size_t>(v)];
  const Eigen::Vector3d p_cam = camera.T_cam_body * (T_body_map * landmark.position);
  if (p_cam.z() < 0.05) return p;
  p.pixel = camera.lens.project(p_cam);
  if (!camera.lens.contains(p.pixel)) return p;
  const double distance = p_cam.norm();
  const Eigen::Vector3d normal_cam =
      camera.T_cam_body.rotation * (T_body_map.rotation * landmark.normal);
  if (p_cam.dot(normal_cam) < kMinViewCosine * distance) return p;
  const double level = std::log(landmark.max_distance / distance) / std::log(level_scale);
  const int top = static_cast<int>(rig.noise.level_scales.size()) - 1;
  if (level < -1.5 || level > top + 1.5) return p;
  p.level = std::clamp(static_cast<int>(std::lround(level)), 0, top);
  p.right_x = p.pixel.x() - camera.disparity_of(p.pixel, p_cam.z());
  p.visible = true;
  return p;
}

}  // namespace

int find_feature(const Landmark& landmark, const StereoView& view, int v, const Pose& T_body_map,
                 const EstimatorRig& rig, double level_scale, const ProjectionSearch& search,
                 const std::vector<int>* taken) {
  const Prediction p = predict(landmark, v, T_body_map, rig, level_scale);
  if (!p.visible) return -1;
  thread_local std::vector<int> near;
  near.clear();
  const double radius = search.radius * rig.noise.level_scales[static_cast<std::size_t>(p.level)];
  view.grid.query(static_cast<float>(p.pixel.x()), static_cast<float>(p.pixel.y()),
                  static_cast<float>(radius), p.level - 1, p.level + 1, near);
  int best = -1;
  int best_distance = 257;
  int next_distance = 257;
  for (const int i : near) {
    const auto f = static_cast<std::size_t>(i);
    if (taken != nullptr && (*taken)[f] >= 0) continue;
    const StereoMatch& stereo = view.stereo[f];
    if (stereo.depth > 0 && std::abs(stereo.x_right - p.right_x) > radius) continue;
    const int distance = hamming_distance(landmark.descriptor, view.features.descriptors[f]);
    if (distance < best_distance) {
      next_distance = best_distance;
      best_distance = distance;
      best = i;
    } else {
      next_distance = std::min(next_distance, distance);
    }
  }
  const bool distinct = best_distance < search.second_best * next_distance;
  return best_distance <= search.max_hamming && distinct ? best : -1;
}

int match_by_projection(const Map& map, const std::vector<int>& landmarks,
                        const FrameFeatures& frame, const Pose& T_map_body, const EstimatorRig& rig,
                        const ProjectionSearch& search, Associations& associations) {
  int added = 0;
  for (std::size_t v = 0; v < frame.views.size(); ++v) {
    const Pose T_body_map = view_pose(frame, v, T_map_body, rig).inverse();
    const StereoView& view = frame.views[v];
    std::vector<int>& taken = associations[v];
    std::vector<char> matched(map.landmarks().size(), 0);
    for (const int id : taken) {
      if (id >= 0) matched[static_cast<std::size_t>(id)] = 1;
    }
    const std::vector<int> before = taken;
    for (const int id : landmarks) {
      const Landmark& landmark = map.landmark(id);
      if (landmark.removed || matched[static_cast<std::size_t>(id)]) continue;
      const int f = find_feature(landmark, view, static_cast<int>(v), T_body_map, rig,
                                 map.level_scale(), search, &before);
      if (f < 0) continue;
      int& slot = taken[static_cast<std::size_t>(f)];
      if (slot >= 0) {  // two landmarks ask for one feature: the more alike has it
        const Descriptor& seen = view.features.descriptors[static_cast<std::size_t>(f)];
        if (hamming_distance(map.landmark(slot).descriptor, seen) <=
            hamming_distance(landmark.descriptor, seen)) {
          continue;
        }
        --added;
      }
      slot = id;
      ++added;
    }
  }
  return added;
}

}  // namespace vinebench::slam
