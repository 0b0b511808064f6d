// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "sim/assets/asset.h"

namespace vinebench::sim {

/// A rover as it looks: the visible geoms (groups 0 to 2, not wholly transparent) of the body that
/// carries the joint `chassis` in its MJCF file, and of all that hangs on it, in the body's frame
/// and at the joints' zero. Boxes, spheres, ellipsoids, cylinders, capsules and meshes, in the
/// colours that the file gives them. Throws Error that names the file when it is missing, invalid
/// or shows nothing.
Asset rover_asset(const std::filesystem::path& mjcf);

/// Makes it the rover that Renderer::Request places.
void add_rover(Scene& scene, const std::filesystem::path& mjcf);

}  // namespace vinebench::sim
