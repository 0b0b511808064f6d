// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/stereo_rig.h"

#include <algorithm>

#include "core/util/error.h"
#include "slam/camera/rectification.h"

namespace vinebench::slam {
namespace {

bool same_lens(const PinholeCamera& a, const PinholeCamera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy;
}

/// Whether the right camera is on the left camera's x axis and parallel to it, with the same lens.
bool is_rectified(const RigCamera& left, const RigCamera& right) {
  if (left.model.has_distortion() || right.model.has_distortion() ||
      !same_lens(left.model, right.model)) {
    return false;
  }
  const Pose T_left_right = left.T_body_cam.inverse() * right.T_body_cam;
  const Eigen::Vector3d& offset = T_left_right.translation;
  // A hundredth of a pixel at this focal length is the most that a row may be off.
  const double tolerance = 0.01 / left.model.fx;
  return angle_of(T_left_right.rotation) < tolerance && offset.x() > 0 &&
         offset.tail<2>().norm() < tolerance * offset.x();
}

RectifiedPair make_pair(const Rig& rig, const StereoPair& pair) {
  const RigCamera& left = rig.cameras[static_cast<std::size_t>(pair.left)];
  const RigCamera& right = rig.cameras[static_cast<std::size_t>(pair.right)];
  RectifiedPair camera;
  camera.name = pair.name;
  camera.left_camera = pair.left;
  camera.right_camera = pair.right;
  if (is_rectified(left, right)) {
    camera.lens = left.model;
    camera.baseline = rig.baseline(pair);
    camera.T_body_cam = left.T_body_cam;
  } else {
    const std::string what = fmt::format("rig '{}': stereo pair '{}'", rig.name, pair.name);
    camera.rectification = std::make_shared<Rectification>(left, right, what);
    camera.lens = camera.rectification->lens();
    camera.baseline = camera.rectification->baseline();
    camera.T_body_cam = camera.rectification->T_body_left();
  }
  camera.T_cam_body = camera.T_body_cam.inverse();
  return camera;
}

}  // namespace

StereoRig make_stereo_rig(const Rig& rig, const std::vector<std::string>& names) {
  std::vector<std::string> unknown = names;
  const auto selected = [&](const std::string& name) {
    std::erase(unknown, name);
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  StereoRig used;
  used.cameras = rig.cameras;
  used.imu = rig.imu;
  for (const StereoPair& pair : rig.stereo_pairs) {
    if (selected(pair.name)) used.pairs.push_back(make_pair(rig, pair));
  }
  for (const int camera : rig.tag_cameras) {
    if (selected(rig.cameras[static_cast<std::size_t>(camera)].name)) {
      used.tag_cameras.push_back(camera);
    }
  }
  if (!unknown.empty()) {
    fail("slam.cameras: rig '{}' has no stereo pair or tag camera named '{}'", rig.name,
         unknown.front());
  }
  if (used.pairs.empty()) {
    fail("slam.cameras: expected at least one stereo pair of rig '{}'", rig.name);
  }
  return used;
}

}  // namespace vinebench::slam
