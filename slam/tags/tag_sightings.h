// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "core/slam_system.h"
#include "slam/camera/tag_cameras.h"

namespace vinebench::slam {

/// Corners of a tag of side `size` in its own frame (x right, y down), in the order of TagSighting.
std::array<Eigen::Vector3d, 4> tag_corners(double size);

/// Whether two of whatever names a tag name the same.
template <class A, class B>
bool same_tag(const A& a, const B& b) {
  return a.id == b.id && a.family == b.family;
}

/// Standard deviation of a sighting's corners, px: their noise and `systematic`.
double corner_sigma(const TagSighting& sighting, double systematic);

/// A corner where the tag camera would see it without distortion, px.
Eigen::Vector2d ideal_corner(const TagSighting& sighting, std::size_t corner,
                             const TagCameras& cameras);

/// The sighting as the camera would have had it at the frame's stamp, for a body with that velocity
/// (in its own frame, m/s and rad/s); unchanged where the image is of that instant.
void bring_to_stamp(const Vector6d& velocity, const TagCameras& cameras, TagSighting& sighting);

/// The tag as the sighting has it, in the body frame.
Pose T_body_tag(const TagSighting& sighting, const TagCameras& cameras);

}  // namespace vinebench::slam
