// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/row_index.h"

#include <algorithm>
#include <cmath>

namespace vinebench::sim {
namespace {

constexpr double kSide = 4.0;  // m, of a square

}  // namespace

RowIndex::RowIndex(const std::vector<RowConfig>& rows) {
  Eigen::AlignedBox2d box;
  for (const RowConfig& row : rows) {
    rows_.push_back({row.start, row.end - row.start});
    box.extend(row.start).extend(row.end);
  }
  if (rows_.empty()) return;
  low_ = box.min().array() - kReach;
  const Eigen::Vector2d size = (box.sizes().array() + 2 * kReach) / kSide;
  columns_ = static_cast<int>(std::ceil(size.x()));
  lines_ = static_cast<int>(std::ceil(size.y()));
  bins_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(lines_));
  const double radius = kReach + kSide * std::sqrt(0.5);
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    const auto column = static_cast<int>(bin) % columns_, line = static_cast<int>(bin) / columns_;
    const Eigen::Vector2d middle = low_ + kSide * Eigen::Vector2d(column + 0.5, line + 0.5);
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      if (rows_[row].distance(middle) < radius) bins_[bin].push_back(static_cast<int>(row));
    }
  }
}

double RowIndex::Segment::distance(const Eigen::Vector2d& p) const {
  const double t = std::clamp((p - start).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (p - start - t * way).norm();
}

double RowIndex::distance(const Eigen::Vector2d& p) const {
  double nearest = kReach;
  if (rows_.empty()) return nearest;
  const Eigen::Vector2d place = (p - low_) / kSide;
  const int column = static_cast<int>(std::floor(place.x()));
  const int line = static_cast<int>(std::floor(place.y()));
  if (column < 0 || line < 0 || column >= columns_ || line >= lines_) return nearest;
  for (const int row : bins_[static_cast<std::size_t>(line * columns_ + column)]) {
    nearest = std::min(nearest, rows_[static_cast<std::size_t>(row)].distance(p));
  }
  return nearest;
}

}  // namespace vinebench::sim
