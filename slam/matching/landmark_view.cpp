// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/landmark_view.h"

namespace vinebench::slam {
namespace {

constexpr double kMargin = 6;       // px
constexpr double kNearest = 0.05;   // m
constexpr double kMinCosine = 0.5;  // of 60 degrees

}  // namespace

std::optional<LandmarkView> view_landmark(const Landmark& landmark, const Pose& T_cam_map,
                                          const PinholeCamera& lens) {
  const Eigen::Vector3d p_cam = T_cam_map * landmark.position;
  if (p_cam.z() < kNearest) return std::nullopt;
  const Eigen::Vector2d pixel = lens.project(p_cam);
  if (!lens.contains(pixel, kMargin)) return std::nullopt;
  if (p_cam.dot(T_cam_map.rotation * landmark.normal) < kMinCosine * p_cam.norm()) {
    return std::nullopt;
  }
  return LandmarkView{pixel, p_cam.z()};
}

}  // namespace vinebench::slam
