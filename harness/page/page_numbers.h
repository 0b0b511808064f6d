// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "core/geometry/pose.h"

namespace vinebench::harness {

// Numbers as a page has them: no longer than what it can show.

/// Four significant digits; null if it is no number.
nlohmann::ordered_json brief(double value);

/// Four decimals: positions to 0.1 mm, quaternions to 1e-4, errors to 0.1 um.
nlohmann::ordered_json decimal(double value);

/// x, y, z (m), qx, qy, qz, qw.
std::array<double, 7> pose_values(const Pose& pose);

/// xx, xy, xz, yy, yz, zz of a covariance in axes that are turned by R: of R C R^T.
nlohmann::ordered_json covariance_json(const Eigen::Matrix3d& R, const Eigen::Matrix3d& C);

}  // namespace vinebench::harness
