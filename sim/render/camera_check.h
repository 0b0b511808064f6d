// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/camera.h"

namespace vinebench::sim {

inline constexpr int kLargestImage = 8192;  ///< pixels a side

/// Throws Error unless it is an ideal pinhole whose image an engine can hold.
void check_camera(const PinholeCamera& camera);

}  // namespace vinebench::sim
