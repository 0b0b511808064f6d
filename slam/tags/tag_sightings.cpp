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

Pose T_body_tag(const TagSighting& sighting, const TagCameras& cameras) {
  return cameras.cameras[static_cast<std::size_t>(sighting.camera)].T_body_cam * sighting.T_cam_tag;
}

}  // namespace vinebench::slam
