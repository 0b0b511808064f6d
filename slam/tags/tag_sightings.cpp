// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_sightings.h"

#include <cmath>

namespace vinebench::slam {

std::array<Eigen::Vector3d, 4> tag_corners(double size) {
  const double h = size / 2;
  return {Eigen::Vector3d(-h, h, 0), {h, h, 0}, {h, -h, 0}, {-h, -h, 0}};
}

double corner_sigma(const TagSighting& sighting, double systematic) {
  return std::hypot(sighting.corner_sigma, systematic);
}

Eigen::Vector2d ideal_corner(const TagSighting& sighting, std::size_t corner,
                             const TagCameras& cameras) {
  const auto camera = static_cast<std::size_t>(sighting.camera);
  const PinholeCamera& lens = cameras.cameras[camera].model;
  return cameras.undistorted[camera].lens.project(lens.unproject(sighting.corners[corner]));
}

void bring_to_stamp(const Vector6d& velocity, const TagCameras& cameras, TagSighting& sighting) {
  if (sighting.late == 0) return;
  const RigCamera& camera = cameras.cameras[static_cast<std::size_t>(sighting.camera)];
  const Pose T_now_then = step_of(velocity * sighting.late);
  const Pose T_cam_moved = camera.T_body_cam.inverse() * T_now_then * camera.T_body_cam;
  // A corner is where its ray meets the tag's plane.
  const Eigen::Vector3d normal = sighting.T_cam_tag.rotation * Eigen::Vector3d::UnitZ();
  const double distance = normal.dot(sighting.T_cam_tag.translation);
  for (Eigen::Vector2d& corner : sighting.corners) {
    const Eigen::Vector3d ray = camera.model.unproject(corner);
    const Eigen::Vector3d moved = T_cam_moved * (ray * (distance / normal.dot(ray)));
    if (moved.z() > 0) corner = camera.model.project(moved);
  }
  sighting.T_cam_tag = T_cam_moved * sighting.T_cam_tag;
  sighting.late = 0;
}

Pose T_body_tag(const TagSighting& sighting, const TagCameras& cameras) {
  return cameras.cameras[static_cast<std::size_t>(sighting.camera)].T_body_cam * sighting.T_cam_tag;
}

}  // namespace vinebench::slam
