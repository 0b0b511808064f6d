// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros/ros_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/util/error.h"
#include "harness/datasets/format/rectified.h"
#include "slam/camera/rectification.h"

namespace vinebench::harness {
namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

void expect_ros_name(const std::string& name) {
  const auto is_allowed = [](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  if (!name.empty() && is_letter(name[0]) && std::ranges::all_of(name, is_allowed)) return;
  fail("ros: camera '{}': expected a name of letters, digits and _ that begins with a letter",
       name);
}

/// `shift` is P's fourth number: -fx times the baseline in a right camera.
std::array<double, 12> ros_projection(const PinholeCamera& lens, double shift) {
  return {lens.fx, 0, lens.cx, shift, 0, lens.fy, lens.cy, 0, 0, 0, 1, 0};
}

std::array<double, 9> rows_of(const Eigen::Matrix3d& m) {
  std::array<double, 9> rows{};
  for (Eigen::Index i = 0; i < 9; ++i) rows[static_cast<std::size_t>(i)] = m(i / 3, i % 3);
  return rows;
}

std::string distortion_model(const RigCamera& camera) {
  switch (camera.model.lens) {
    case LensModel::kRadialTangential:
      return "plumb_bob";
    case LensModel::kEquidistant:
      return "equidistant";
    case LensModel::kDoubleSphere:
      break;
  }
  fail("ros: camera '{}': ROS has no double-sphere lenses", camera.name);
}

RosCamera alone(const RigCamera& camera) {
  expect_ros_name(camera.name);
  const PinholeCamera& c = camera.model;
  RosCamera ros;
  ros.frame = camera.name + "_optical_frame";
  ros.images = fmt::format("/{}/image_{}", camera.name, c.has_distortion() ? "raw" : "rect");
  ros.info = fmt::format("/{}/camera_info", camera.name);
  ros.calibration.header.frame = ros.frame;
  ros.calibration.width = c.width;
  ros.calibration.height = c.height;
  ros.calibration.model = distortion_model(camera);
  ros.calibration.D = c.coefficients();
  if (c.lens == LensModel::kRadialTangential) ros.calibration.D.resize(5);  // k3
  ros.calibration.K = {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1};
  ros.calibration.R = rows_of(Eigen::Matrix3d::Identity());
  ros.calibration.P = ros_projection(c, 0);
  return ros;
}

/// Sets the rectification of the two cameras of a pair.
void rectify(const Rig& rig, const StereoPair& pair, std::vector<RosCamera>& cameras) {
  const auto left = static_cast<std::size_t>(pair.left);
  const auto right = static_cast<std::size_t>(pair.right);
  const slam::Rectification view(rig.cameras[left], rig.cameras[right],
                                 fmt::format("ros: pair '{}'", pair.name));
  for (const std::size_t index : {left, right}) {
    const RigCamera& camera = rig.cameras[index];
    cameras[index].images = fmt::format("/{}/image_raw", camera.name);
    cameras[index].calibration.R = rows_of(
        (view.T_body_left().rotation.conjugate() * camera.T_body_cam.rotation).toRotationMatrix());
    const double shift = index == right ? -view.lens().fx * view.baseline() : 0;
    cameras[index].calibration.P = ros_projection(view.lens(), shift);
  }
}

}  // namespace

std::vector<RosCamera> ros_cameras(const Rig& rig) {
  std::vector<RosCamera> cameras;
  for (const RigCamera& camera : rig.cameras) cameras.push_back(alone(camera));
  std::set<int> calibrated;  // a camera has one calibration, that of its first pair
  for (const StereoPair& pair : rig.stereo_pairs) {
    if (calibrated.contains(pair.left) || calibrated.contains(pair.right)) continue;
    calibrated.insert({pair.left, pair.right});
    const PinholeCamera& lens = rig.cameras[static_cast<std::size_t>(pair.right)].model;
    if (is_rectified(rig, pair)) {
      cameras[static_cast<std::size_t>(pair.right)].calibration.P =
          ros_projection(lens, -lens.fx * rig.baseline(pair));
    } else {
      rectify(rig, pair, cameras);
    }
  }
  return cameras;
}

}  // namespace vinebench::harness
