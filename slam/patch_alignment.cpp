// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/patch_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>

namespace vinebench {
namespace {

constexpr int kRadius = 5;
constexpr int kSide = 2 * kRadius + 1;
constexpr int kArea = kSide * kSide;
constexpr int kSearch = 5;            ///< px, whole shifts tried on either side of the guess
constexpr int kMaxSteps = 5;          ///< of Gauss-Newton
constexpr double kConverged = 0.005;  ///< px
constexpr double kMaxCorrection =
    2;  ///< px; a solution farther from the whole shift is not its own
/// Slopes are expected within about 0.4 px a pixel, and pixels to agree within about 4 grey levels.
constexpr double kSlopePrior = (4.0 / 0.4) * (4.0 / 0.4);

using Window = std::array<float, kArea>;
using Vector3f = Eigen::Vector3f;

/// Left window with its mean removed, and its derivatives by shift and slopes, of zero mean too.
struct Template {
  Window grey;
  std::array<Vector3f, kArea> derivative;
  Eigen::Matrix3f normal = Eigen::Matrix3f::Zero();
};

Template make_template(const cv::Mat& left, int x, int y) {
  Template t;
  float mean = 0;
  Vector3f mean_derivative = Vector3f::Zero();
  std::size_t i = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    const std::uint8_t* row = left.ptr<std::uint8_t>(y + dy) + x;
    for (int dx = -kRadius; dx <= kRadius; ++dx, ++i) {
      const float gradient = 0.5F * static_cast<float>(row[dx + 1] - row[dx - 1]);
      t.grey[i] = row[dx];
      t.derivative[i] = gradient * Vector3f(1, static_cast<float>(dx), static_cast<float>(dy));
      mean += t.grey[i];
      mean_derivative += t.derivative[i];
    }
  }
  mean /= kArea;
  mean_derivative /= kArea;
  for (i = 0; i < kArea; ++i) {
    t.grey[i] -= mean;
    t.derivative[i] -= mean_derivative;
    t.normal += t.derivative[i] * t.derivative[i].transpose();
  }
  return t;
}

int sum(const cv::Mat& picture, int x, int y) {
  int total = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    const std::uint8_t* row = picture.ptr<std::uint8_t>(y + dy) + x;
    for (int dx = -kRadius; dx <= kRadius; ++dx) total += row[dx];
  }
  return total;
}

/// Sum of absolute differences of two windows, each less its mean (rounded).
int zero_mean_sad(const cv::Mat& left, int x_left, const cv::Mat& right, int x_right, int y,
                  int left_sum) {
  const int offset = (left_sum - sum(right, x_right, y)) / kArea;
  int total = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    const std::uint8_t* a = left.ptr<std::uint8_t>(y + dy) + x_left;
    const std::uint8_t* b = right.ptr<std::uint8_t>(y + dy) + x_right;
    for (int dx = -kRadius; dx <= kRadius; ++dx) total += std::abs(a[dx] - b[dx] - offset);
  }
  return total;
}

/// Column of `right` with the best window about `guess`; -1 where it is at the end of the search
/// or of the picture.
int search_whole(const cv::Mat& left, const cv::Mat& right, int x, int y, int guess) {
  const int first = std::max(kRadius, guess - kSearch);
  const int last = std::min(right.cols - 1 - kRadius, guess + kSearch);
  const int left_sum = sum(left, x, y);
  int best = -1;
  int least = std::numeric_limits<int>::max();
  for (int column = first; column <= last; ++column) {
    const int sad = zero_mean_sad(left, x, right, column, y, left_sum);
    if (sad >= least) continue;
    least = sad;
    best = column;
  }
  return best == first || best == last ? -1 : best;
}

/// Cubic interpolation (Catmull-Rom) of a row; the caller keeps x in [1, columns - 2).
float sample(const std::uint8_t* row, float x) {
  const int at = static_cast<int>(x);
  const float f = x - static_cast<float>(at);
  const float a = row[at - 1];
  const float b = row[at];
  const float c = row[at + 1];
  const float d = row[at + 2];
  return b + 0.5F * f * (c - a + f * (2 * a - 5 * b + 4 * c - d + f * (3 * (b - c) + d - a)));
}

/// Right window under (position, slope along x, slope along y), its mean removed.
bool warp(const cv::Mat& right, int y, const Vector3f& p, Window& window) {
  const float reach = kRadius * (1 + std::abs(p[1]) + std::abs(p[2]));
  if (!(p[0] - reach >= 1) || !(p[0] + reach < static_cast<float>(right.cols - 2))) return false;
  float mean = 0;
  std::size_t i = 0;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    const std::uint8_t* row = right.ptr<std::uint8_t>(y + dy);
    const float centre = p[0] + p[2] * static_cast<float>(dy);
    for (int dx = -kRadius; dx <= kRadius; ++dx, ++i) {
      window[i] = sample(row, centre + (1 + p[1]) * static_cast<float>(dx));
      mean += window[i];
    }
  }
  mean /= kArea;
  for (float& grey : window) grey -= mean;
  return true;
}

}  // namespace

std::optional<PatchAlignment> align_patch(const cv::Mat& left, const cv::Mat& right, int x, int y,
                                          double guess) {
  const cv::Rect inside(kRadius + 1, kRadius, left.cols - kSide - 1, left.rows - kSide + 1);
  if (left.size() != right.size() || !inside.contains({x, y})) return std::nullopt;
  const int whole = search_whole(left, right, x, y, static_cast<int>(std::lround(x - guess)));
  if (whole < 0) return std::nullopt;

  const Template t = make_template(left, x, y);
  Eigen::Matrix3f normal = t.normal;
  normal(1, 1) += static_cast<float>(kSlopePrior);
  normal(2, 2) += static_cast<float>(kSlopePrior);
  const Eigen::LLT<Eigen::Matrix3f> solver(normal);
  if (solver.info() != Eigen::Success) return std::nullopt;

  Vector3f p(static_cast<float>(whole), 0, 0);
  Window window;
  for (int step = 0; step < kMaxSteps; ++step) {
    if (!warp(right, y, p, window)) return std::nullopt;
    Vector3f gradient(0, static_cast<float>(kSlopePrior) * p[1],
                      static_cast<float>(kSlopePrior) * p[2]);
    for (std::size_t i = 0; i < kArea; ++i) gradient += t.derivative[i] * (window[i] - t.grey[i]);
    const Vector3f delta = solver.solve(gradient);
    p -= delta;
    if (!(std::abs(p[0] - static_cast<float>(whole)) < kMaxCorrection)) return std::nullopt;
    if (std::abs(delta[0]) < kConverged) break;
  }
  if (!warp(right, y, p, window)) return std::nullopt;
  float difference = 0;
  float contrast = 0;
  for (std::size_t i = 0; i < kArea; ++i) {
    difference += std::abs(window[i] - t.grey[i]);
    contrast += std::abs(t.grey[i]);
  }
  return PatchAlignment{static_cast<double>(x) - static_cast<double>(p[0]),
                        -static_cast<double>(p[1]), -static_cast<double>(p[2]),
                        static_cast<double>(difference) / kArea,
                        static_cast<double>(contrast) / kArea};
}

}  // namespace vinebench
