// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sim/render/gl/platform/gl_objects.h"

namespace vinebench::sim {

/// Axes of the sun's view: z away from the sun.
Eigen::Matrix3d sun_from_world(const Eigen::Vector3d& towards_sun);

/// Orthographic: takes the world to a clip space that a box of the sun's axes fills, but for a
/// margin.
Eigen::Matrix4d light_from_world(const Eigen::Matrix3d& R_sun_world,
                                 const Eigen::AlignedBox3d& box);

/// The clip space, -1 to 1, to a map's texture coordinates and depth, 0 to 1.
Eigen::Matrix4d map_from_light();

/// A target that draws into a depth texture alone; left bound.
GlFramebuffer make_depth_framebuffer(const GlFunctions& gl, const GlTexture& texture);

}  // namespace vinebench::sim
