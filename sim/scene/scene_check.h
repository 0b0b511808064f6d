// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/scene/scene.h"

namespace vinebench::sim {

/// Throws Error that names the invalid part of the scene: an image that is empty, of the wrong type
/// or too large, an index out of range, a number that is not finite.
void check_scene(const Scene& scene);

}  // namespace vinebench::sim
