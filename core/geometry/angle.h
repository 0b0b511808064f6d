// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace vinebench {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

}  // namespace vinebench
