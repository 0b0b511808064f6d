// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/scene/scene.h"

namespace vinebench::sim {

/// Throws Error that names the part of the scene that cannot be drawn: an image that is empty, of
/// another kind or too large, something that names what the scene has not, a number that is none.
void check_scene(const Scene& scene);

}  // namespace vinebench::sim
