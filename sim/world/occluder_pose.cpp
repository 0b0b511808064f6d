// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/occluder_pose.h"

#include <algorithm>

#include "core/geometry/angle.h"

namespace vinebench::sim {
namespace {

double lowest_ground(const Occluder& occluder, const Eigen::Vector2d& at, double yaw,
                     const Terrain& terrain) {
  const Eigen::Rotation2Dd turn(yaw);
  const Eigen::Vector3d size = size_of(occluder);
  double lowest = terrain.height(at);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Eigen::Vector2d corner = turn * Eigen::Vector2d(x * size.x(), y * size.y());
      lowest = std::min(lowest, terrain.height(at + corner));
    }
  }
  return lowest;
}

/// The occluder standing at a place.
Pose standing_pose(const Occluder& occluder, const Eigen::Vector2d& at, double yaw_deg,
                   const Terrain& terrain) {
  const double yaw = yaw_deg * kRadiansPerDegree;
  if (occluder.shape == Occluder::Shape::kCrate) {
    Pose lying = terrain.lie(at, yaw, size_of(occluder).y() / 2);
    lying.translation.z() += occluder.lift;
    return lying;
  }
  const bool person = occluder.shape == Occluder::Shape::kPerson;
  const double ground = person ? terrain.height(at) : lowest_ground(occluder, at, yaw, terrain);
  return {from_roll_pitch_yaw({0, 0, yaw}), {at.x(), at.y(), ground + occluder.lift}};
}

}  // namespace

Pose occluder_pose(const Occluder& occluder, const Terrain& terrain) {
  if (occluder.path) return OccluderMotion(occluder, terrain).at(0);
  return standing_pose(occluder, occluder.position, occluder.yaw_deg, terrain);
}

OccluderMotion::OccluderMotion(const Occluder& occluder, const Terrain& terrain)
    : occluder_(occluder), terrain_(terrain), motion_(occluder.path.value()) {}

Pose OccluderMotion::at(Stamp stamp) const {
  const Eigen::Vector3d there = motion_.at(stamp);
  const double yaw_deg = occluder_.yaw_deg + there.z() / kRadiansPerDegree;
  return standing_pose(occluder_, there.head<2>(), yaw_deg, terrain_);
}

}  // namespace vinebench::sim
