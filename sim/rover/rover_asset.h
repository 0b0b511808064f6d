// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "sim/assets/asset.h"

namespace vinebench::sim {

/// The visual model of a rover: the visible geoms (groups 0 to 2, not completely transparent) of
/// the body with the joint `chassis` in its MJCF file, and of its child bodies, in the body's frame
/// and at the joints' zero. Boxes, spheres, ellipsoids, cylinders, capsules and meshes, in the
/// file's colours. Throws Error that names the file if it is missing, invalid or has no visible
/// geom.
Asset rover_asset(const std::filesystem::path& mjcf);

/// Makes it the rover that RenderRequest places.
void add_rover(Scene& scene, const std::filesystem::path& mjcf);

}  // namespace vinebench::sim
