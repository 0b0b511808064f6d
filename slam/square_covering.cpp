// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/square_covering.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vinebench {
namespace {

/// A result this near to the wanted count ends the bisection.
constexpr double kTolerance = 0.03;
constexpr int kMaxSteps = 16;

/// Covers the picture greedily with squares around the strongest corners.
class Covering {
 public:
  Covering(const std::vector<Corner>& corners, int width, int height)
      : corners_(corners), width_(width), height_(height) {}

  /// Corners that are kept when squares reach about `radius` px; stops when beyond `limit`.
  const std::vector<Corner>& cover(double radius, std::size_t limit) {
    kept_.clear();
    // A square reaches two grid cells each way, so a cell is half of the radius.
    const double per_cell = 2.0 / radius;
    columns_ = static_cast<int>(width_ * per_cell) + 1;
    rows_ = static_cast<int>(height_ * per_cell) + 1;
    covered_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
    for (const Corner& corner : corners_) {
      const int column = static_cast<int>(corner.x * per_cell);
      const int row = static_cast<int>(corner.y * per_cell);
      if (covered_[at(row, column)] != 0) continue;
      kept_.push_back(corner);
      if (kept_.size() > limit) break;
      mark(row, column);
    }
    return kept_;
  }

 private:
  std::size_t at(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  void mark(int row, int column) {
    const int first = std::max(0, column - 2);
    const int last = std::min(columns_ - 1, column + 2);
    for (int r = std::max(0, row - 2); r <= std::min(rows_ - 1, row + 2); ++r) {
      std::fill(covered_.begin() + static_cast<std::ptrdiff_t>(at(r, first)),
                covered_.begin() + static_cast<std::ptrdiff_t>(at(r, last)) + 1, char{1});
    }
  }

  const std::vector<Corner>& corners_;
  int width_;
  int height_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<char> covered_;
  std::vector<Corner> kept_;
};

void sort_strongest_first(std::vector<Corner>& corners) {
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return std::tuple(-a.score, a.y, a.x) < std::tuple(-b.score, b.y, b.x);
  });
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
  for (int step = 0; step < kMaxSteps; ++step) {
    const double radius = (low + high) / 2;
    const std::vector<Corner>& kept = covering.cover(radius, wanted);
    if (kept.size() > wanted) {
      low = radius;
      continue;
    }
    high = radius;
    if (kept.size() > best.size()) best = kept;
    if (static_cast<double>(best.size()) >= (1 - kTolerance) * count) break;
  }
  return best;
}

}  // namespace vinebench
