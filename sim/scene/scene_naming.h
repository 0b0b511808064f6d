// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/truth/scene_index.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// The kind of a thing whose parts have that label.
Thing thing_of(Label label);

/// The meaning of a number of RenderedImage::instances. Throws Error for a number that the scene
/// does not have.
InstanceName instance_name(const Scene& scene, std::int32_t number);

/// The names, poses and surface points of all instances of a scene, without meshes.
SceneIndex index_of(const Scene& scene);

}  // namespace vinebench::sim
