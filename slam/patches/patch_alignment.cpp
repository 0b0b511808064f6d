// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/patches/patch_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "slam/patches/warped_window.h"

namespace vinebench::slam {
namespace {

constexpr int kAlignedArea = kAlignedSide * kAlignedSide;
constexpr int kSearch = 5;          ///< px, whole shifts tried on either side of the guess
constexpr int kAlignmentSteps = 5;  ///< of Gauss-Newton
constexpr double kAlignmentConverged = 0.005;  ///< px
constexpr double kMaxCorrection =
    2;  ///< px; a solution farther from the whole shift is not its own
/// Slopes are expected within about 0.4 px a pixel, and pixels to agree within about 4 grey levels.
constexpr double kSlopePrior = (4.0 / 0.4) * (4.0 / 0.4);

constexpr int kLanes = 4;
using Vector3f = Eigen::Vector3f;

/// Sum of products, in a fixed order whatever the processor's width.
float dot(const PitchedWindow& a, const PitchedWindow& b) {
  std::array<float, kLanes> lanes{};
  for (std::size_t i = 0; i < a.size(); i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) lanes[k] += a[i + k] * b[i + k];
  }
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

/// 1 where a pixel counts.
const PitchedWindow& ones() {
  static const PitchedWindow window = [] {
    PitchedWindow w;
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = i % kWindowPitch < kAlignedSide ? 1.0F : 0.0F;
    return w;
  }();
  return window;
}

void remove_mean(PitchedWindow& window) {
  const float mean = dot(window, ones()) / kAlignedArea;
  for (std::size_t i = 0; i < window.size(); ++i) window[i] = (window[i] - mean) * ones()[i];
}

/// Mean absolute deviation from the mean.
float deviation(PitchedWindow window) {
  remove_mean(window);
  for (float& value : window) value = std::abs(value);
  return dot(window, ones()) / kAlignedArea;
}

/// Left window, and its derivatives by shift and slopes, of zero mean: the brightness solved for.
struct Template {
  PitchedWindow grey;
  std::array<PitchedWindow, 3> derivative;
  Eigen::Matrix3f normal;
};

Template make_template(const cv::Mat& left, int x, int y) {
  Template t;
  std::size_t i = 0;
  for (int dy = -kAlignedRadius; dy <= kAlignedRadius; ++dy, ++i) {
    const std::uint8_t* row = left.ptr<std::uint8_t>(y + dy) + x;
    for (int dx = -kAlignedRadius; dx <= kAlignedRadius; ++dx, ++i) {
      const float gradient = 0.5F * static_cast<float>(row[dx + 1] - row[dx - 1]);
      t.grey[i] = row[dx];
      t.derivative[0][i] = gradient;
      t.derivative[1][i] = gradient * static_cast<float>(dx);
      t.derivative[2][i] = gradient * static_cast<float>(dy);
    }
    t.grey[i] = 0;
    for (PitchedWindow& derivative : t.derivative) derivative[i] = 0;
  }
  for (PitchedWindow& derivative : t.derivative) remove_mean(derivative);
  for (int r = 0; r < 3; ++r) {
    for (int c = r; c < 3; ++c) {
      t.normal(r, c) =
          dot(t.derivative[static_cast<std::size_t>(r)], t.derivative[static_cast<std::size_t>(c)]);
      t.normal(c, r) = t.normal(r, c);
    }
  }
  return t;
}

/// Eight grey levels as whole numbers of 16 bits, which the processor treats at once.
using Eight [[gnu::vector_size(16)]] = std::int16_t;

Eight load_eight(const std::uint8_t* at) {
  using Bytes [[gnu::vector_size(8)]] = std::uint8_t;
  Bytes bytes;
  std::memcpy(&bytes, at, sizeof bytes);
  return __builtin_convertvector(bytes, Eight);
}

constexpr int kTriedLanes = 16;  ///< tried columns are 11 at most; two times eight are computed
static_assert(2 * kSearch + 1 <= kTriedLanes);
/// The right image's rows as far as windows at all tried columns reach.
using Strip = std::array<std::array<std::uint8_t, kAlignedSide + kTriedLanes - 1>, kAlignedSide>;

Strip cut_strip(const cv::Mat& right, int first, int last, int y) {
  Strip strip{};
  const auto bytes = static_cast<std::size_t>(last - first + kAlignedSide);
  for (int row = 0; row < kAlignedSide; ++row) {
    std::memcpy(strip[static_cast<std::size_t>(row)].data(),
                right.ptr<std::uint8_t>(y - kAlignedRadius + row) + first - kAlignedRadius, bytes);
  }
  return strip;
}

/// By how much the left window is brighter than the right one at each of eight columns, rounded.
Eight brightness_offsets(int left_sum, const Strip& strip, std::size_t lane) {
  Eight sums{};
  for (std::size_t row = 0; row < kAlignedSide; ++row) {
    for (std::size_t column = 0; column < kAlignedSide; ++column) {
      sums += load_eight(&strip[row][column + lane]);
    }
  }
  Eight offsets;
  for (int k = 0; k < 8; ++k)
    offsets[k] = static_cast<std::int16_t>((left_sum - sums[k]) / kAlignedArea);
  return offsets;
}

using LeftWindow = std::array<std::int16_t, kAlignedArea>;

/// Sums of absolute differences at eight columns, windows less their mean. The largest possible,
/// 121 * 510, fits 16 bits without a sign.
void zero_mean_sads(const LeftWindow& left, int left_sum, const Strip& strip, std::size_t lane,
                    std::uint16_t* sads) {
  const Eight offsets = brightness_offsets(left_sum, strip, lane);
  Eight sum{};
  const std::int16_t* grey = left.data();
  for (std::size_t row = 0; row < kAlignedSide; ++row) {
    for (std::size_t column = 0; column < kAlignedSide; ++column, ++grey) {
      const Eight difference = *grey - load_eight(&strip[row][column + lane]) - offsets;
      sum += difference < 0 ? -difference : difference;
    }
  }
  std::memcpy(sads, &sum, sizeof sum);
}

std::array<std::uint16_t, kTriedLanes> zero_mean_sads(const cv::Mat& left, int x, int y,
                                                      const Strip& strip) {
  LeftWindow window;
  int left_sum = 0;
  std::size_t i = 0;
  for (int dy = -kAlignedRadius; dy <= kAlignedRadius; ++dy) {
    const std::uint8_t* row = left.ptr<std::uint8_t>(y + dy) + x;
    for (int dx = -kAlignedRadius; dx <= kAlignedRadius; ++dx, ++i) left_sum += window[i] = row[dx];
  }
  std::array<std::uint16_t, kTriedLanes> sads;
  zero_mean_sads(window, left_sum, strip, 0, sads.data());
  zero_mean_sads(window, left_sum, strip, 8, sads.data() + 8);
  return sads;
}

/// Column of `right` with the best window about `guess`; -1 where it is at the end of the search
/// or of the image.
int search_whole(const cv::Mat& left, const cv::Mat& right, int x, int y, int guess) {
  const int first = std::max(kAlignedRadius, guess - kSearch);
  const int last = std::min(right.cols - 1 - kAlignedRadius, guess + kSearch);
  if (first > last) return -1;
  const auto sads = zero_mean_sads(left, x, y, cut_strip(right, first, last, y));
  const auto end = sads.begin() + (last - first + 1);
  const int best = first + static_cast<int>(std::min_element(sads.begin(), end) - sads.begin());
  return best == first || best == last ? -1 : best;
}

/// Right window under (position, slope along x, slope along y), less the left one.
bool compare(const cv::Mat& right, int y, const Vector3f& p, const PitchedWindow& left,
             PitchedWindow& residual) {
  const float reach = kAlignedRadius * (1 + std::abs(p[1]) + std::abs(p[2]));
  if (!(p[0] - reach >= 1) || !(p[0] + reach < static_cast<float>(right.cols - 2))) return false;
  warped_difference(right.ptr<std::uint8_t>(y), static_cast<std::ptrdiff_t>(right.step[0]),
                    {p[0], p[1], p[2]}, left, residual);
  return true;
}

}  // namespace

std::optional<PatchAlignment> align_patch(const cv::Mat& left, const cv::Mat& right, int x, int y,
                                          double guess) {
  const cv::Rect inside(kAlignedRadius + 1, kAlignedRadius, left.cols - kAlignedSide - 1,
                        left.rows - kAlignedSide + 1);
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
  PitchedWindow residual;
  bool converged = false;
  for (int step = 0; step < kAlignmentSteps && !converged; ++step) {
    if (!compare(right, y, p, t.grey, residual)) return std::nullopt;
    Vector3f gradient(0, static_cast<float>(kSlopePrior) * p[1],
                      static_cast<float>(kSlopePrior) * p[2]);
    for (int k = 0; k < 3; ++k) {
      gradient[k] += dot(t.derivative[static_cast<std::size_t>(k)], residual);
    }
    const Vector3f delta = solver.solve(gradient);
    p -= delta;
    if (!(std::abs(p[0] - static_cast<float>(whole)) < kMaxCorrection)) return std::nullopt;
    converged = std::abs(delta[0]) < kAlignmentConverged;
  }
  // Once converged, what is left before the last step is as good as what is left after it.
  if (!converged && !compare(right, y, p, t.grey, residual)) return std::nullopt;
  return PatchAlignment{static_cast<double>(x) - static_cast<double>(p[0]),
                        -static_cast<double>(p[1]), -static_cast<double>(p[2]),
                        static_cast<double>(deviation(residual)),
                        static_cast<double>(deviation(t.grey))};
}

}  // namespace vinebench::slam
