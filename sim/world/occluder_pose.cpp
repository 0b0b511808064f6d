// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/occluder_pose.h"

#include <algorithm>
#include <numbers>

namespace vinebench::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

double lowest_ground(const Occluder& occluder, const Terrain& terrain) {
  const Eigen::Rotation2Dd turn(occluder.yaw_deg * kRadians);
  const Eigen::Vector3d size = size_of(occluder);
  double lowest = terrain.height(occluder.position);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Eigen::Vector2d corner = turn * Eigen::Vector2d(x * size.x(), y * size.y());
      lowest = std::min(lowest, terrain.height(occluder.position + corner));
    }
  }
  return lowest;
}

}  // namespace

Pose occluder_pose(const Occluder& occluder, const Terrain& terrain) {
  const Eigen::Vector2d& at = occluder.position;
  const double yaw = occluder.yaw_deg * kRadians;
  if (occluder.shape == Occluder::Shape::kCrate) {
    Pose lying = terrain.lie(at, yaw, size_of(occluder).y() / 2);
    lying.translation.z() += occluder.lift;
    return lying;
  }
  const bool person = occluder.shape == Occluder::Shape::kPerson;
  const double ground = person ? terrain.height(at) : lowest_ground(occluder, terrain);
  return {from_roll_pitch_yaw({0, 0, yaw}), {at.x(), at.y(), ground + occluder.lift}};
}

}  // namespace vinebench::sim
