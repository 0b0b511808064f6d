// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "sim/scene/scene.h"

namespace vinebench::sim {

/// Light of a value of 1 in the sky's image, encoded.
inline constexpr double kSkyBrightest = 1.2;

/// A sky with soft gradients, a glow around the sun and a few soft clouds drawn by seed, sRGB in
/// CV_8UC4. The direction (x, y, z), of length 1, in the world is at uv = 0.5 + 0.5 / 1.4 * (x, y)
/// / (1 + z).
cv::Mat sky_image(const Light& light, std::uint64_t seed);

}  // namespace vinebench::sim
