// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/eye_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "slam/stereo/match_sample.h"

namespace vinebench::slam {
namespace {

/// The right image is put straight anew where that changes a row by more.
constexpr double kRowsChanged = 0.02;  // px

/// What is expected before anything was seen, as standard deviations: px, all others by share.
constexpr double kExpectedShift = 2;
constexpr double kExpectedShare = 0.01;

/// Share of what the frames before said that still counts in the next one.
constexpr double kMemory = 0.95;

constexpr std::size_t kWindowsMeasured = 200;  ///< of a frame, up to twice as many
constexpr std::size_t kFewestWindows = 25;
constexpr int kHalfWindow = 5;      // px, of a window
constexpr double kWindowNoise = 2;  // grey levels, at least
/// What a window's shape in the two eyes differs by, which its noise does not explain.
constexpr double kWindowSpread = 0.2;  // px of its level
constexpr double kFarthest = 1.5;      // px of its level; a step beyond is no measurement
constexpr double kOutlying = 2;        ///< standard deviations at which a window counts half
constexpr int kReweightings = 4;

/// Shifts are searched for where fewer of that many features are found, over these many rows to
/// either side, with a sample of the features.
constexpr int kFeaturesToSearch = 50;
constexpr double kNextToNothing = 0.1;
constexpr int kMostRows = 4;
constexpr std::size_t kSample = 150;
constexpr std::size_t kClearlyMore = 2;
constexpr int kPause = 10;  ///< frames after a search in vain

/// By how much a window lies on another row.
struct StepAcross {
  double shift;     ///< px of its level
  double variance;  ///< px^2 of its level
};

/// Where a left window's surface is in the right image, px of a level.
struct RightWindow {
  double x;        ///< of its middle
  double slope_x;  ///< change of the disparity, px a px
  double slope_y;
};

/// One Gauss-Newton step in both directions from the window about (x, y) of `left` to the right one
/// on the same rows, less their means.
std::optional<StepAcross> step_of_window(const cv::Mat& left, int x, int y, const cv::Mat& right,
                                         const RightWindow& there) {
  const double reach = 1 + kHalfWindow * (1 + std::abs(there.slope_x) + std::abs(there.slope_y));
  if (x <= kHalfWindow || x >= left.cols - kHalfWindow - 1 || y <= kHalfWindow ||
      y >= left.rows - kHalfWindow - 1 || !(there.x >= reach) ||
      !(there.x < right.cols - 1 - reach)) {
    return std::nullopt;
  }
  constexpr int kSide = 2 * kHalfWindow + 1;
  using Window = Eigen::Array<float, kSide * kSide, 1>;
  Window along, across, difference;
  Eigen::Index i = 0;
  for (int dy = -kHalfWindow; dy <= kHalfWindow; ++dy) {
    const auto* above = left.ptr<std::uint8_t>(y + dy - 1) + x;
    const auto* row = left.ptr<std::uint8_t>(y + dy) + x;
    const auto* below = left.ptr<std::uint8_t>(y + dy + 1) + x;
    const auto* other = right.ptr<std::uint8_t>(y + dy);
    for (int dx = -kHalfWindow; dx <= kHalfWindow; ++dx, ++i) {
      along[i] = 0.5F * static_cast<float>(row[dx + 1] - row[dx - 1]);
      across[i] = 0.5F * static_cast<float>(below[dx] - above[dx]);
      const double column = there.x + dx - there.slope_x * dx - there.slope_y * dy;
      const int whole = static_cast<int>(column);
      const auto fraction = static_cast<float>(column - whole);
      const float seen = (1 - fraction) * static_cast<float>(other[whole]) +
                         fraction * static_cast<float>(other[whole + 1]);
      difference[i] = seen - static_cast<float>(row[dx]);
    }
  }
  along -= along.mean();
  across -= across.mean();
  difference -= difference.mean();
  Eigen::Matrix2f normal;
  normal << along.square().sum(), (along * across).sum(), (along * across).sum(),
      across.square().sum();
  const float apart = normal.determinant() / std::max(1.0F, normal(0, 0));  // of y, x unknown
  if (!(apart > 1)) return std::nullopt;
  const Eigen::Vector2f step =
      -normal.inverse() * Eigen::Vector2f((along * difference).sum(), (across * difference).sum());
  if (!step.allFinite() || step.cwiseAbs().maxCoeff() > static_cast<float>(kFarthest)) {
    return std::nullopt;
  }
  const float left_over = (difference + step.x() * along + step.y() * across).square().mean();
  const double noise = std::max(kWindowNoise * kWindowNoise, static_cast<double>(left_over));
  return StepAcross{static_cast<double>(step.y()),
                    noise / static_cast<double>(apart) + kWindowSpread * kWindowSpread};
}

/// A sample of the finest level's features, as they stand in the rows from `first` to `last`.
Extraction sample_rows(const Extraction& left, int first, int last) {
  Extraction sample;
  sample.pyramid = {left.pyramid.front().rowRange(first, last)};
  const Features& all = left.features;
  const auto finest = static_cast<std::size_t>(
      std::ranges::count_if(all.keypoints, [](const Keypoint& k) { return k.level == 0; }));
  const std::size_t every = std::max<std::size_t>(1, finest / kSample);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Keypoint keypoint = all.keypoints[i];
    if (keypoint.level != 0 || seen++ % every != 0) continue;
    keypoint.y -= static_cast<float>(first);
    sample.features.keypoints.push_back(keypoint);
    sample.features.descriptors.push_back(all.descriptors[i]);
  }
  return sample;
}

}  // namespace

EyeAlignment::EyeAlignment(const PinholeCamera& lens, const RowTolerance& tolerance)
    : lens_(lens), tolerance_(tolerance) {
  forget();
}

/// As before anything was seen.
void EyeAlignment::forget() {
  information_.setIdentity();
  information_ /= kExpectedShare * kExpectedShare;
  information_.diagonal().head<2>().setConstant(1 / (kExpectedShift * kExpectedShift));
  information_vector_.setZero();
}

Eigen::RowVector<double, EyeAlignment::kUnknowns> EyeAlignment::row_of(double x, double y,
                                                                       double disparity) const {
  const double column = x - lens_.cx;
  const double row = y - lens_.cy;
  return {
      1, column * row / (lens_.fx * lens_.fy), column, row, disparity, disparity * row / lens_.fy};
}

double EyeAlignment::correction(double x, double y) const {
  return row_of(x, y, disparity_used_).dot(used_);
}

/// Puts the image straight for what is mostly seen: things of another depth remain a little off.
void EyeAlignment::use(const Unknowns& known) {
  const auto now = [&](double x, double y) { return row_of(x, y, disparity_).dot(known); };
  double squares = 0;  // px^2
  double change = 0;   // px
  for (const double x : {0.0, 0.5, 1.0}) {
    for (const double y : {0.0, 0.5, 1.0}) {
      const double column = x * lens_.width;
      const double row = y * lens_.height;
      const double shift = now(column, row);
      squares += shift * shift / 9;
      change = std::max(change, std::abs(shift - correction(column, row)));
    }
  }
  if (std::abs(now(lens_.cx, lens_.cy)) <= tolerance_.middle &&
      std::sqrt(squares) <= tolerance_.everywhere) {
    used_.setZero();
    return;
  }
  if (!used_.isZero() && change <= kRowsChanged) return;
  used_ = known;
  disparity_used_ = disparity_;
  fill_maps();
}

void EyeAlignment::fill_maps() {
  cv::Mat columns(lens_.height, lens_.width, CV_32FC1);
  cv::Mat rows(columns.size(), CV_32FC1);
  for (int y = 0; y < lens_.height; ++y) {
    const double first = y + correction(0, y);
    const double slope = correction(1, y) - correction(0, y);  // a row's correction is linear
    for (int x = 0; x < lens_.width; ++x) {
      columns.at<float>(y, x) = static_cast<float>(x);
      rows.at<float>(y, x) = static_cast<float>(first + slope * x);
    }
  }
  cv::convertMaps(columns, rows, whole_, fraction_, CV_16SC2);
}

cv::Mat EyeAlignment::aligned(const cv::Mat& right) const {
  if (used_.isZero()) return right;
  cv::Mat straight;
  cv::remap(right, straight, whole_, fraction_, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return straight;
}

bool EyeAlignment::search_shift(const Extraction& left, const std::vector<cv::Mat>& right,
                                const std::vector<StereoMatch>& matches, const Search& search) {
  if (frames_to_wait_ > 0) {
    --frames_to_wait_;
    return false;
  }
  const std::size_t features = matches.size();
  const std::size_t found = count_found(matches);
  if (features < kFeaturesToSearch ||
      static_cast<double>(found) >= kNextToNothing * static_cast<double>(features)) {
    return false;
  }
  const int rows = left.pyramid.front().rows;
  std::array<std::size_t, 2 * kMostRows + 1> counts{};
  for (int shift = -kMostRows; shift <= kMostRows; ++shift) {
    const Extraction sample = sample_rows(left, std::max(0, -shift), std::min(rows, rows - shift));
    const Extraction shifted{
        {}, {right.front().rowRange(std::max(0, shift), std::min(rows, rows + shift))}};
    counts[static_cast<std::size_t>(shift + kMostRows)] = count_found(search(sample, shifted));
  }
  const auto most = std::ranges::max_element(counts);
  if (*most < kFewestWindows || *most < kClearlyMore * counts[kMostRows]) {
    frames_to_wait_ = kPause;
    return false;
  }
  Unknowns known = Unknowns::Zero();
  known[0] =
      correction(lens_.cx, lens_.cy) + static_cast<double>(most - counts.begin()) - kMostRows;
  forget();
  information_vector_ = information_ * known;
  use(known);
  return true;
}

void EyeAlignment::measure(const Extraction& left, const std::vector<cv::Mat>& right,
                           const std::vector<StereoMatch>& matches, const OrbExtractor& extractor) {
  std::vector<WindowRow> windows;
  for (const std::size_t i : sample_found(matches, kWindowsMeasured)) {
    const Keypoint& keypoint = left.features.keypoints[i];
    const auto level = static_cast<std::size_t>(keypoint.level);
    const double pixel = extractor.scale_of(keypoint.level);
    const auto x = static_cast<double>(keypoint.x);
    const auto y = static_cast<double>(keypoint.y);
    const double disparity = x - static_cast<double>(matches[i].x_right);
    const int column = static_cast<int>(std::lround(to_level(x, pixel)));
    const int row = static_cast<int>(std::lround(to_level(y, pixel)));
    const RightWindow there{column - disparity / pixel,
                            static_cast<double>(matches[i].slant_x) * disparity,
                            static_cast<double>(matches[i].slant_y) * disparity};
    const auto step = step_of_window(left.pyramid[level], column, row, right[level], there);
    if (!step) continue;
    windows.push_back(
        {x, y, disparity, correction(x, y) + step->shift * pixel, step->variance * pixel * pixel});
  }
  if (windows.size() < kFewestWindows) return;
  add(windows);
  use(information_.ldlt().solve(information_vector_));
}

/// Weighted least squares with a Cauchy loss, beside what is known.
void EyeAlignment::add(const std::vector<WindowRow>& windows) {
  const Eigen::Matrix<double, kUnknowns, kUnknowns> before = kMemory * information_;
  const Unknowns vector_before = kMemory * information_vector_;
  double disparities = 0;
  for (const WindowRow& window : windows) disparities += window.disparity;
  disparities /= static_cast<double>(windows.size());
  disparity_ += (disparity_ == 0 ? 1 : 1 - kMemory) * (disparities - disparity_);
  for (int k = 0; k < kReweightings; ++k) {
    const Unknowns found = information_.ldlt().solve(information_vector_);
    information_ = before;
    information_vector_ = vector_before;
    for (const WindowRow& window : windows) {
      const auto row = row_of(window.x, window.y, window.disparity);
      const double off = window.shift - row.dot(found);
      const double weight = 1 / (window.variance + off * off / (kOutlying * kOutlying));
      information_ += weight * row.transpose() * row;
      information_vector_ += weight * window.shift * row.transpose();
    }
  }
}

}  // namespace vinebench::slam
