// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/scene/mesh_builder.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// sRGB, 0 to 1, to linear RGB.
Eigen::Vector3f linear_colour(const Eigen::Vector3d& srgb);

/// One face of a block: its middle, and half its sides to the right and up as seen from outside.
/// Sky's light is dimmed at its foot.
void add_face(MeshBuilder& builder, const Eigen::Vector3f& middle, const Eigen::Vector3f& right,
              const Eigen::Vector3f& up, const TextureCell& cell, float foot_occlusion = 1);

/// A whole block, each face with the whole texture.
void add_block(MeshBuilder& builder, const Eigen::Vector3f& centre, const Eigen::Vector3f& half,
               float foot_occlusion = 1);

}  // namespace vinebench::sim
