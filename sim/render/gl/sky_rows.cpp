// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/sky_rows.h"

#include <cstdint>

namespace vinebench::sim {
namespace {

constexpr int kBands = 32;
constexpr float kLowestSky = -0.07f;  // sine of the elevation; the land begins at -0.05

}  // namespace

/// Rays that point down by more than an angle are a convex cone: a band is inside if its corners
/// are.
std::vector<Eigen::Vector2f> rows_with_sky(const Eigen::Matrix4f& ray_from_clip) {
  const auto below = [&](float x, float y) {
    const Eigen::Vector3f ray = ray_from_clip.topLeftCorner<3, 3>() * Eigen::Vector3f(x, y, 1);
    return ray.z() < kLowestSky * ray.norm();
  };
  const auto row = [](int band) { return 2.0f * static_cast<float>(band) / kBands - 1; };
  std::vector<Eigen::Vector2f> ranges;
  for (int band = 0; band < kBands; ++band) {
    const Eigen::Vector2f rows(row(band), row(band + 1));
    if (below(-1, rows.x()) && below(1, rows.x()) && below(-1, rows.y()) && below(1, rows.y())) {
      continue;
    }
    if (!ranges.empty() && ranges.back().y() == rows.x()) {
      ranges.back().y() = rows.y();
    } else {
      ranges.push_back(rows);
    }
  }
  return ranges;
}

Eigen::Vector4f below_horizon(const cv::Mat& sky_image) {
  const auto& corner = sky_image.at<cv::Vec4b>(0, 0);
  const Eigen::Vector3f bytes(corner[0], corner[1], corner[2]);
  Eigen::Vector4f colour = Eigen::Vector4f::Zero();
  colour.head<3>() = bytes / 255;
  return colour;
}

}  // namespace vinebench::sim
