// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "core/geometry/rig.h"
#include "core/time.h"

namespace vinebench::harness {

/// Whether a YAML file is a camera chain of Kalibr: it has a camera `cam0`.
bool is_kalibr_chain(const std::filesystem::path& file);

/// What a chain tells.
struct KalibrChain {
  Rig rig;  ///< the cameras cam0, cam1, ..., pairs as by pair_in_order(); without a rate
  std::vector<Stamp> image_delays;  ///< as Recording's
};

/// The body is the inertial unit (`T_cam_imu`); without one it is at cam0, x ahead, y left, z up,
/// and the others follow by `T_cn_cnm1`. A camera's `timeshift_cam_imu` (s, the unit's clock less
/// the camera's) is the delay of its images. Throws Error with file and line.
KalibrChain load_kalibr_chain(const std::filesystem::path& file);

/// The first two cameras become a pair, and so do the next two; the rest are tag cameras.
void pair_in_order(Rig& rig);

}  // namespace vinebench::harness
