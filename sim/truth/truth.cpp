// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/truth/truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace vinebench::sim {

double label_share(const cv::Mat& labels, Label wanted) {
  if (labels.empty()) return 0;
  std::int64_t count = 0;
  for (int y = 0; y < labels.rows; ++y) {
    const auto* row = labels.ptr<std::uint8_t>(y);
    count += std::count(row, row + labels.cols, static_cast<std::uint8_t>(wanted));
  }
  return static_cast<double>(count) / static_cast<double>(labels.total());
}

Occlusion occlusion_in(const cv::Mat& labels, const std::vector<OccluderClass>& classes) {
  Occlusion occlusion;
  for (const OccluderClass one : classes) {
    occlusion.share(one) = label_share(labels, label_of(one));
  }
  return occlusion;
}

std::vector<OccluderClass> occluder_classes(const WorldConfig& world) {
  std::set<OccluderClass> classes;
  for (const Occluder& occluder : world.occluders) classes.insert(class_of(occluder));
  return {classes.begin(), classes.end()};
}

bool is_tag_visible(const WorldTag& tag, const PinholeCamera& camera, const Pose& T_world_cam,
                    const cv::Mat& labels, double min_side) {
  const Pose T_cam_tag = T_world_cam.inverse() * tag.T_world_tag;
  const Eigen::Vector3d normal = T_cam_tag.rotation * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d sight = T_cam_tag.translation.normalized();
  if (sight.dot(normal) < std::cos(75.0 * 3.14159265358979 / 180.0)) return false;
  // The centre and points a twentieth inside the corners, whose label is certainly the tag's.
  const double h = tag.size / 2;
  const std::array<Eigen::Vector2d, 5> places{
      Eigen::Vector2d(-h, h), {h, h}, {h, -h}, {-h, -h}, {0, 0}};
  std::array<Eigen::Vector2d, 5> pixels;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3d p_cam = T_cam_tag * Eigen::Vector3d(places[i].x(), places[i].y(), 0);
    if (p_cam.z() <= 0.02) return false;
    pixels[i] = camera.project(p_cam);
    if (!camera.contains(pixels[i], 2)) return false;
    const Eigen::Vector3d inside =
        T_cam_tag * Eigen::Vector3d(0.95 * places[i].x(), 0.95 * places[i].y(), 0);
    const Eigen::Vector2d at = camera.project(inside);
    const auto label = labels.at<std::uint8_t>(static_cast<int>(std::lround(at.y())),
                                               static_cast<int>(std::lround(at.x())));
    if (label != static_cast<std::uint8_t>(Label::kTag)) return false;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if ((pixels[i] - pixels[(i + 1) % 4]).norm() < min_side) return false;
  }
  return true;
}

}  // namespace vinebench::sim
