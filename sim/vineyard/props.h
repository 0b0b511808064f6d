// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/scene/scene.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {

/// Printed tags, each on its white board. The print's plane is exactly that of tag_pose.
void add_tags(Scene& scene, const WorldConfig& world, const WorldLayout& layout);

/// The print and its board's white rim: each module is a whole number of texels wide, so that the
/// module edges lie on texel borders in every mip level down to one texel a module.
Texture tag_texture(const std::string& family, int id);

}  // namespace vinebench::sim
