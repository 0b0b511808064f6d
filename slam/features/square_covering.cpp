// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/square_covering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

namespace vinebench::slam {
namespace {

/// A result this near to the wanted count ends the bisection.
constexpr double kTolerance = 0.03;
constexpr int kMaxSteps = 16;
constexpr int kScores = 256;  ///< grey levels

/// Covers the image greedily with squares around the strongest corners.
class Covering {
 public:
  Covering(const std::vector<Corner>& corners, int width, int height)
      : corners_(corners), width_(width), height_(height) {}

  /// Corners that are kept when squares reach about `radius` px.
  const std::vector<Corner>& cover(double radius) {
    kept_.clear();
    // A square reaches two grid cells each way, so a cell is half of the radius. The grid has two
    // more on either side, so that no square leaves it.
    const auto per_cell = static_cast<float>(2 / radius);
    columns_ = static_cast<int>(static_cast<float>(width_) * per_cell) + 1 + 2 * kReach;
    const int rows = static_cast<int>(static_cast<float>(height_) * per_cell) + 1 + 2 * kReach;
    covered_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows), 0);
    for (const Corner& corner : corners_) {
      const int column = static_cast<int>(static_cast<float>(corner.x) * per_cell);
      const int row = static_cast<int>(static_cast<float>(corner.y) * per_cell);
      char* square = &covered_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                               static_cast<std::size_t>(column)];
      if (square[kReach * columns_ + kReach] != 0) continue;
      kept_.push_back(corner);
      for (int r = 0; r < kSide; ++r, square += columns_) std::memset(square, 1, kSide);
    }
    return kept_;
  }

 private:
  static constexpr int kReach = 2;
  static constexpr int kSide = 2 * kReach + 1;
  const std::vector<Corner>& corners_;
  int width_;
  int height_;
  int columns_ = 0;
  std::vector<char> covered_;
  std::vector<Corner> kept_;
};

/// Strongest first, equals by row, then column, in which order corners are found: counting sort.
void sort_strongest_first(std::vector<Corner>& corners) {
  const auto by_place = [](const Corner& a, const Corner& b) {
    return std::pair(a.y, a.x) < std::pair(b.y, b.x);
  };
  if (!std::is_sorted(corners.begin(), corners.end(), by_place)) {
    std::sort(corners.begin(), corners.end(), by_place);
  }
  std::array<std::size_t, kScores + 1> begins{};
  const auto rank = [](const Corner& c) { return static_cast<std::size_t>(kScores - 1 - c.score); };
  for (const Corner& corner : corners) ++begins[rank(corner) + 1];
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<Corner> sorted(corners.size());
  for (const Corner& corner : corners) sorted[begins[rank(corner)]++] = corner;
  corners.swap(sorted);
}

}  // namespace

std::vector<Corner> suppress_square_covering(std::vector<Corner> corners, int count, int width,
                                             int height) {
  sort_strongest_first(corners);
  if (count <= 0) return {};
  const auto wanted = static_cast<std::size_t>(count);
  if (corners.size() <= wanted) return corners;

  Covering covering(corners, width, height);
  std::vector<Corner> best;
  double low = 1;  // keeps too many, or all
  double high = 2 * std::sqrt(static_cast<double>(width) * height / count) + 2;  // keeps too few
  double radius = high / 3;
  for (int step = 0; step < kMaxSteps; ++step) {
    const std::vector<Corner>& kept = covering.cover(radius);
    const auto size = static_cast<double>(kept.size());
    (kept.size() > wanted ? low : high) = radius;
    if (kept.size() <= wanted && kept.size() > best.size()) best = kept;
    if (static_cast<double>(best.size()) >= (1 - kTolerance) * count) break;
    // About as many squares fit as their area allows; halves the range where that leads out of it.
    radius *= std::sqrt(size / ((1 - kTolerance / 2) * count));
    if (!(radius > low && radius < high)) radius = (low + high) / 2;
  }
  return best;
}

}  // namespace vinebench::slam
