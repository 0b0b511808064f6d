// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/patch.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace vinebench {
namespace {

constexpr int kInner = PatchWarp::kRadius;  // gradients need one pixel around
constexpr int kPixels = PatchWarp::kSide * PatchWarp::kSide;
constexpr int kMaxSteps = 8;
constexpr float kConverged = 0.01F;  // px
constexpr float kMaxRun = 2.0F;      // px
/// Mean squared gradient along the weaker direction: noise of 2 grey levels over 81 pixels then
/// leaves 2 sqrt(2) / sqrt(8 * 81) = 0.1 px.
constexpr float kMinTexture = 8;

/// Bilinear interpolation; the caller keeps the point inside.
float sample(const cv::Mat& picture, float x, float y) {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const float fx = x - static_cast<float>(column);
  const float fy = y - static_cast<float>(row);
  const std::uint8_t* a = picture.ptr<std::uint8_t>(row) + column;
  const std::uint8_t* b = picture.ptr<std::uint8_t>(row + 1) + column;
  const float above = static_cast<float>(a[0]) + fx * static_cast<float>(a[1] - a[0]);
  const float below = static_cast<float>(b[0]) + fx * static_cast<float>(b[1] - b[0]);
  return above + fy * (below - above);
}

bool inside(const cv::Mat& picture, double x, double y, double reach) {
  return x >= reach && y >= reach && x + reach < picture.cols - 1 && y + reach < picture.rows - 1;
}

/// The patch's inner pixels, mean removed, with their gradients.
struct Template {
  std::array<float, kPixels> grey;
  std::array<Eigen::Vector2f, kPixels> gradient;
  Eigen::Matrix2f normal = Eigen::Matrix2f::Zero();
  float contrast = 0;

  explicit Template(const Patch& patch) {
    const auto at = [&](int dx, int dy) {
      return static_cast<float>(patch.grey[static_cast<std::size_t>(
          (dy + Patch::kRadius) * Patch::kSide + dx + Patch::kRadius)]);
    };
    float mean = 0;
    Eigen::Vector2f mean_gradient = Eigen::Vector2f::Zero();
    std::size_t i = 0;
    for (int dy = -kInner; dy <= kInner; ++dy) {
      for (int dx = -kInner; dx <= kInner; ++dx, ++i) {
        grey[i] = at(dx, dy);
        gradient[i] = 0.5F * Eigen::Vector2f(at(dx + 1, dy) - at(dx - 1, dy),
                                             at(dx, dy + 1) - at(dx, dy - 1));
        mean += grey[i];
        mean_gradient += gradient[i];
      }
    }
    mean /= kPixels;
    mean_gradient /= kPixels;
    for (i = 0; i < kPixels; ++i) {
      grey[i] -= mean;
      contrast += std::abs(grey[i]) / kPixels;
      gradient[i] -= mean_gradient;
      normal += gradient[i] * gradient[i].transpose();
    }
  }

  /// The smaller eigenvalue of the normal matrix tells how well the weaker direction is held.
  bool can_be_placed() const {
    const float half_trace = 0.5F * normal.trace();
    const float root = std::sqrt(std::max(0.0F, half_trace * half_trace - normal.determinant()));
    return half_trace - root > kMinTexture * kPixels;
  }
};

/// The picture's pixels under the warped patch, mean removed.
void read_window(const cv::Mat& picture, const PatchWarp& warp, const Eigen::Vector2f& centre,
                 std::array<float, kPixels>& window) {
  float mean = 0;
  for (std::size_t i = 0; i < kPixels; ++i) {
    const Eigen::Vector2f at = centre + warp.offset[i];
    window[i] = sample(picture, at.x(), at.y());
    mean += window[i];
  }
  mean /= kPixels;
  for (float& grey : window) grey -= mean;
}

/// How far the warped patch reaches from its centre, px.
double reach_of(const PatchWarp& warp) {
  float reach = 0;
  for (const Eigen::Vector2f& offset : warp.offset) {
    reach = std::max(reach, offset.lpNorm<Eigen::Infinity>());
  }
  return static_cast<double>(reach) + 1;
}

}  // namespace

PatchWarp make_warp(const Eigen::Matrix3d& H) {
  PatchWarp warp;
  const auto map = [&](double x, double y) -> Eigen::Vector2d {
    return (H * Eigen::Vector3d(x, y, 1)).hnormalized();
  };
  const Eigen::Vector2d centre = map(0, 0);
  std::size_t i = 0;
  for (int dy = -kInner; dy <= kInner; ++dy) {
    for (int dx = -kInner; dx <= kInner; ++dx, ++i) {
      warp.offset[i] = (map(dx, dy) - centre).cast<float>();
    }
  }
  warp.jacobian.col(0) = (0.5 * (map(1, 0) - map(-1, 0))).cast<float>();
  warp.jacobian.col(1) = (0.5 * (map(0, 1) - map(0, -1))).cast<float>();
  return warp;
}

std::optional<Patch> cut_patch(const cv::Mat& picture, double x, double y) {
  if (!inside(picture, x, y, Patch::kRadius)) return std::nullopt;
  Patch patch;
  std::size_t i = 0;
  for (int dy = -Patch::kRadius; dy <= Patch::kRadius; ++dy) {
    for (int dx = -Patch::kRadius; dx <= Patch::kRadius; ++dx, ++i) {
      patch.grey[i] = static_cast<std::uint8_t>(
          std::lround(sample(picture, static_cast<float>(x + dx), static_cast<float>(y + dy))));
    }
  }
  return patch;
}

std::optional<PatchFit> fit_patch(const Patch& patch, const PatchWarp& warp, const cv::Mat& picture,
                                  double x, double y) {
  const Template t(patch);
  if (!t.can_be_placed()) return std::nullopt;
  const Eigen::Matrix2f step_of = warp.jacobian * t.normal.inverse();
  const double reach = reach_of(warp);
  const Eigen::Vector2f start(static_cast<float>(x), static_cast<float>(y));
  Eigen::Vector2f centre = start;
  std::array<float, kPixels> window;
  for (int step = 0; step < kMaxSteps; ++step) {
    if (!inside(picture, centre.x(), centre.y(), reach)) return std::nullopt;
    read_window(picture, warp, centre, window);
    Eigen::Vector2f right_side = Eigen::Vector2f::Zero();
    for (std::size_t i = 0; i < kPixels; ++i) right_side += t.gradient[i] * (window[i] - t.grey[i]);
    const Eigen::Vector2f delta = step_of * right_side;
    centre -= delta;
    if (!((centre - start).norm() < kMaxRun)) return std::nullopt;
    if (delta.norm() < kConverged) break;
  }
  if (!inside(picture, centre.x(), centre.y(), reach)) return std::nullopt;
  read_window(picture, warp, centre, window);
  float difference = 0;
  for (std::size_t i = 0; i < kPixels; ++i) difference += std::abs(window[i] - t.grey[i]) / kPixels;
  return PatchFit{static_cast<double>(centre.x()), static_cast<double>(centre.y()),
                  static_cast<double>(difference), static_cast<double>(t.contrast)};
}

}  // namespace vinebench
