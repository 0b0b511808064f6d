// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "sim/scene/scene.h"

namespace vinebench::sim {

/// Light that the sky's image stores as 1, encoded.
inline constexpr double kSkyBrightest = 1.2;

/// A sky of soft gradients, a glow around the sun and a few soft clouds of that seed, sRGB in
/// CV_8UC4. The direction (x, y, z), of length 1, in the world is at
/// uv = 0.5 + 0.5 / 1.4 * (x, y) / (1 + z).
cv::Mat sky_image(const Light& light, std::uint64_t seed);

}  // namespace vinebench::sim
