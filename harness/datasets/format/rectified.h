// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry/rig.h"

namespace vinebench::harness {

/// Whether a pair's cameras are ideal pinholes with the same orientation, side by side along their
/// x axis, with equal fx, fy and cy: to 1e-6 rad and 1e-9 px.
bool is_rectified(const Rig& rig, const StereoPair& pair);

}  // namespace vinebench::harness
