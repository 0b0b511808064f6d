// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "sim/scene/scene.h"

namespace vinebench::test {

/// Whether two textures have the same texels.
inline bool same_texels(const sim::Texture& a, const sim::Texture& b) {
  return a.rgba.size() == b.rgba.size() && cv::norm(a.rgba, b.rgba, cv::NORM_INF) == 0;
}

}  // namespace vinebench::test
