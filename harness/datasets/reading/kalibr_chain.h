// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/geometry/rig.h"

namespace vinebench::harness {

/// Whether a YAML file is a camera chain of Kalibr: it has a camera `cam0`.
bool is_kalibr_chain(const std::filesystem::path& file);

/// The cameras cam0, cam1, ... of a chain, pairs as by pair_in_order(), without a rate. The body is
/// the inertial unit (`T_cam_imu`); without one it is at cam0, x ahead, y left, z up, and the
/// others follow by `T_cn_cnm1`. Throws Error with file and line.
Rig load_kalibr_chain(const std::filesystem::path& file);

/// The first two cameras become a pair, and so do the next two; the rest are tag cameras.
void pair_in_order(Rig& rig);

}  // namespace vinebench::harness
