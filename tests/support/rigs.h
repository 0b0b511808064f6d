// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "slam/camera/stereo_rig.h"

namespace vinebench::test {

/// The rover's rig with its front pair, with front and back pair, or with a third pair: the front
/// pair rotated to the left.
inline slam::StereoRig rig_of_pairs(slam::StereoRig rig, std::size_t pairs) {
  slam::RectifiedPair side = rig.pairs.front();
  const Pose turn{exp_so3({0, 0, std::numbers::pi / 2}), {0, 0, 0}};
  side.name = "third";
  side.T_body_cam = turn * side.T_body_cam;
  side.T_cam_body = side.T_body_cam.inverse();
  for (int* camera : {&side.left_camera, &side.right_camera}) {
    RigCamera turned = rig.cameras[static_cast<std::size_t>(*camera)];
    turned.name = "third_" + turned.name;
    turned.T_body_cam = turn * turned.T_body_cam;
    *camera = static_cast<int>(rig.cameras.size());
    rig.cameras.push_back(turned);
  }
  rig.pairs.push_back(side);
  rig.pairs.resize(pairs);
  return rig;
}

}  // namespace vinebench::test
