// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/patches/patch.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace vinebench::slam {
namespace {

constexpr int kSide = PatchWindow::kSide;
constexpr int kArea = PatchWindow::kArea;
constexpr int kBordered = kSide + 2;  // gradients need one pixel around
constexpr int kMaxSteps = 8;
constexpr float kConverged = 0.01F;  // px
constexpr float kMaxRun = 2.0F;      // px
/// Mean squared gradient along the weaker direction: noise of 2 grey levels over 81 pixels then
/// leaves 2 sqrt(2) / sqrt(8 * 81) = 0.1 px.
constexpr float kMinTexture = 8;

using Window = std::array<float, kArea>;

/// Bilinear interpolation; the caller keeps the point inside.
float sample(const std::uint8_t* grey, std::size_t step, float x, float y) {
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const float fx = x - static_cast<float>(column);
  const float fy = y - static_cast<float>(row);
  const std::uint8_t* a = grey + static_cast<std::size_t>(row) * step + column;
  const std::uint8_t* b = a + step;
  const float above = static_cast<float>(a[0]) + fx * static_cast<float>(a[1] - a[0]);
  const float below = static_cast<float>(b[0]) + fx * static_cast<float>(b[1] - b[0]);
  return above + fy * (below - above);
}

bool inside(const cv::Mat& image, double x, double y, double reach) {
  return x >= reach && y >= reach && x + reach < image.cols - 1 && y + reach < image.rows - 1;
}

float remove_mean(Window& window) {
  float mean = 0;
  for (const float value : window) mean += value;
  mean /= kArea;
  for (float& value : window) value -= mean;
  return mean;
}

/// The patch as the image shows it, with a border of one pixel. False where it does not reach.
bool resample(const Patch& patch, const Eigen::Matrix3d& H_image_patch,
              std::array<float, kBordered * kBordered>& bordered) {
  const Eigen::Vector2d centre = H_image_patch.col(2).hnormalized();
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift.topRightCorner<2, 1>() = centre;
  const Eigen::Matrix3f back = (H_image_patch.inverse() * shift).cast<float>();
  constexpr auto kReach = static_cast<float>(Patch::kRadius);
  std::size_t i = 0;
  for (int dy = -kBordered / 2; dy <= kBordered / 2; ++dy) {
    for (int dx = -kBordered / 2; dx <= kBordered / 2; ++dx, ++i) {
      const auto x = static_cast<float>(dx);
      const auto y = static_cast<float>(dy);
      const float w = 1 / (back(2, 0) * x + back(2, 1) * y + back(2, 2));
      const float px = (back(0, 0) * x + back(0, 1) * y + back(0, 2)) * w + kReach;
      const float py = (back(1, 0) * x + back(1, 1) * y + back(1, 2)) * w + kReach;
      if (!(px >= 0 && py >= 0 && px < 2 * kReach && py < 2 * kReach)) return false;
      bordered[i] = sample(patch.grey.data(), Patch::kSide, px, py);
    }
  }
  return true;
}

/// How well the weaker direction is held: the smaller eigenvalue of the normal matrix.
bool can_be_placed(const Eigen::Matrix2f& normal) {
  const float half_trace = 0.5F * normal.trace();
  const float root = std::sqrt(std::max(0.0F, half_trace * half_trace - normal.determinant()));
  return half_trace - root > kMinTexture * kArea;
}

/// The image's pixels about a point, mean removed. All of them lie at one fraction of a pixel.
void read_window(const cv::Mat& image, const Eigen::Vector2f& centre, Window& window) {
  const float left = centre.x() - PatchWindow::kRadius;
  const float top = centre.y() - PatchWindow::kRadius;
  const int column = static_cast<int>(left);
  const int row = static_cast<int>(top);
  const float fx = left - static_cast<float>(column);
  const float fy = top - static_cast<float>(row);
  std::array<float, kSide> above;
  std::array<float, kSide> below;
  const auto blend = [&](int r, std::array<float, kSide>& line) {
    const std::uint8_t* grey = image.ptr<std::uint8_t>(r) + column;
    for (std::size_t i = 0; i < kSide; ++i) {
      const auto a = static_cast<float>(grey[i]);
      line[i] = a + fx * (static_cast<float>(grey[i + 1]) - a);
    }
  };
  blend(row, above);
  for (int y = 0; y < kSide; ++y) {
    blend(row + y + 1, below);
    float* line = window.data() + y * kSide;
    for (std::size_t i = 0; i < kSide; ++i) line[i] = above[i] + fy * (below[i] - above[i]);
    above = below;
  }
  remove_mean(window);
}

}  // namespace

std::optional<Patch> cut_patch(const cv::Mat& image, double x, double y) {
  if (!inside(image, x, y, Patch::kRadius)) return std::nullopt;
  Patch patch;
  std::size_t i = 0;
  for (int dy = -Patch::kRadius; dy <= Patch::kRadius; ++dy) {
    for (int dx = -Patch::kRadius; dx <= Patch::kRadius; ++dx, ++i) {
      patch.grey[i] = static_cast<std::uint8_t>(
          std::lround(sample(image.ptr<std::uint8_t>(), image.step[0], static_cast<float>(x + dx),
                             static_cast<float>(y + dy))));
    }
  }
  return patch;
}

std::optional<PatchWindow> warp_patch(const Patch& patch, const Eigen::Matrix3d& H_image_patch) {
  std::array<float, kBordered * kBordered> bordered;
  if (!resample(patch, H_image_patch, bordered)) return std::nullopt;
  PatchWindow window;
  std::size_t i = 0;
  for (std::size_t y = 1; y <= kSide; ++y) {
    const float* above = bordered.data() + (y - 1) * kBordered;
    const float* row = above + kBordered;
    const float* below = row + kBordered;
    for (std::size_t x = 1; x <= kSide; ++x, ++i) {
      window.grey[i] = row[x];
      window.gradient_x[i] = 0.5F * (row[x + 1] - row[x - 1]);
      window.gradient_y[i] = 0.5F * (below[x] - above[x]);
    }
  }
  remove_mean(window.grey);
  remove_mean(window.gradient_x);
  remove_mean(window.gradient_y);
  float xx = 0;
  float xy = 0;
  float yy = 0;
  for (i = 0; i < kArea; ++i) {
    window.contrast += std::abs(window.grey[i]);
    xx += window.gradient_x[i] * window.gradient_x[i];
    xy += window.gradient_x[i] * window.gradient_y[i];
    yy += window.gradient_y[i] * window.gradient_y[i];
  }
  window.contrast /= kArea;
  window.normal << xx, xy, xy, yy;
  return window;
}

std::optional<PatchFit> fit_patch(const PatchWindow& wanted, const cv::Mat& image, double x,
                                  double y) {
  if (!can_be_placed(wanted.normal)) return std::nullopt;
  constexpr double kReach = PatchWindow::kRadius + 1;
  const Eigen::Matrix2f step_of = wanted.normal.inverse();
  const Eigen::Vector2f start(static_cast<float>(x), static_cast<float>(y));
  Eigen::Vector2f centre = start;
  Window window;
  for (int step = 0; step < kMaxSteps; ++step) {
    if (!inside(image, centre.x(), centre.y(), kReach)) return std::nullopt;
    read_window(image, centre, window);
    float along_x = 0;
    float along_y = 0;
    for (std::size_t i = 0; i < kArea; ++i) {
      const float difference = window[i] - wanted.grey[i];
      along_x += wanted.gradient_x[i] * difference;
      along_y += wanted.gradient_y[i] * difference;
    }
    const Eigen::Vector2f delta = step_of * Eigen::Vector2f(along_x, along_y);
    centre -= delta;
    if (!((centre - start).norm() < kMaxRun)) return std::nullopt;
    if (delta.norm() < kConverged) break;
  }
  if (!inside(image, centre.x(), centre.y(), kReach)) return std::nullopt;
  read_window(image, centre, window);
  float difference = 0;
  for (std::size_t i = 0; i < kArea; ++i) difference += std::abs(window[i] - wanted.grey[i]);
  return PatchFit{static_cast<double>(centre.x()), static_cast<double>(centre.y()),
                  static_cast<double>(difference / kArea), static_cast<double>(wanted.contrast)};
}

}  // namespace vinebench::slam
