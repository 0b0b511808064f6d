// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string_view>

#include "core/util/random.h"

// Helpers for painting tileable images.

namespace vinebench::sim {

/// Draws a small object on a tileable image, repeated where it crosses the border.
template <class Draw>
void draw_wrapped(const cv::Mat& image, const cv::Point2d& at, double reach, const Draw& draw) {
  for (const int ix : {-1, 0, 1}) {
    for (const int iy : {-1, 0, 1}) {
      const cv::Point2d p(at.x + ix * image.cols, at.y + iy * image.rows);
      if (p.x > -reach && p.y > -reach && p.x < image.cols + reach && p.y < image.rows + reach) {
        draw(p);
      }
    }
  }
}

/// A colour, lighter or darker by up to `amount` of it.
inline cv::Scalar jitter(RandomSequence& random, const cv::Vec3d& colour, double amount) {
  const double light = random.uniform(1 - amount, 1 + amount);
  return {colour[0] * light, colour[1] * light, colour[2] * light};
}

inline cv::Point2d somewhere(RandomSequence& random, const cv::Mat& image) {
  const double x = random.uniform(0, image.cols);
  return {x, random.uniform(0, image.rows)};
}

/// What is green becomes as pale a straw or as dark a brown, in patches that cover that share.
void wither(cv::Mat& rgb, double share, std::uint64_t seed, std::string_view name);

}  // namespace vinebench::sim
