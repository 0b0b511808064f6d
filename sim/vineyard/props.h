// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/scene/mesh_builder.h"
#include "sim/scene/scene.h"
#include "sim/world/world.h"

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

/// Carton boxes, plain or printed.
void add_boxes(Scene& scene, const WorldConfig& world, std::uint64_t seed);

/// Printed tags, each on its white board. The print's plane is exactly that of tag_pose.
void add_tags(Scene& scene, const WorldConfig& world);

/// The print and its board's white rim: each module is a whole number of texels wide, so that the
/// module edges lie on texel borders in every mip level down to one texel a module.
Texture tag_texture(const std::string& family, int id);

inline constexpr double kTagBoardThickness = 0.005;  ///< m

/// Side of what tag_texture shows, in sides of the black square.
double tag_board_scale(const std::string& family);

}  // namespace vinebench::sim
