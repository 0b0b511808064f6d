// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/rectified.h"

#include <cmath>

namespace vinebench::harness {
namespace {

constexpr double kSameAxes = 1e-6;
constexpr double kSameIntrinsics = 1e-9;

}  // namespace

bool is_rectified(const Rig& rig, const StereoPair& pair) {
  const RigCamera& left = rig.cameras.at(static_cast<std::size_t>(pair.left));
  const RigCamera& right = rig.cameras.at(static_cast<std::size_t>(pair.right));
  const Pose T = left.T_body_cam.inverse() * right.T_body_cam;
  const auto same = [](double a, double b) { return std::abs(a - b) <= kSameIntrinsics; };
  const PinholeCamera& l = left.model;
  const PinholeCamera& r = right.model;
  return !l.has_distortion() && !r.has_distortion() && angle_of(T.rotation) <= kSameAxes &&
         T.translation.x() > 0 && T.translation.tail<2>().norm() <= kSameAxes * T.translation.x() &&
         same(l.fx, r.fx) && same(l.fy, r.fy) && same(l.cy, r.cy);
}

}  // namespace vinebench::harness
