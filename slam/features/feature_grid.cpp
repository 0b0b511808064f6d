// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/feature_grid.h"

#include <algorithm>
#include <cmath>

namespace vinebench::slam {
namespace {

/// Cell of a coordinate, those off the image in the outermost ones.
int cell_of(float coordinate, int cell, int count) {
  const double index = std::floor((static_cast<double>(coordinate) + 0.5) / cell);
  return static_cast<int>(std::clamp(index, 0.0, count - 1.0));
}

}  // namespace

FeatureGrid::FeatureGrid(const std::vector<Keypoint>& keypoints, int width, int height)
    : columns_(std::max(1, (width + kCell - 1) / kCell)),
      rows_(std::max(1, (height + kCell - 1) / kCell)),
      cell_begin_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0),
      items_(keypoints.size()) {
  // Counting sort by cell; equal cells keep the order of the indices.
  std::vector<std::size_t> cells;
  cells.reserve(keypoints.size());
  for (const Keypoint& keypoint : keypoints) {
    const int column = cell_of(keypoint.x, kCell, columns_);
    const int row = cell_of(keypoint.y, kCell, rows_);
    cells.push_back(static_cast<std::size_t>(row * columns_ + column));
    ++cell_begin_[cells.back() + 1];
  }
  for (std::size_t i = 1; i < cell_begin_.size(); ++i) cell_begin_[i] += cell_begin_[i - 1];
  std::vector<int> next = cell_begin_;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Item& item = items_[static_cast<std::size_t>(next[cells[i]]++)];
    item.x = keypoints[i].x;
    item.y = keypoints[i].y;
    item.index = static_cast<std::uint32_t>(i) & 0xffffffU;
    item.level = static_cast<std::uint32_t>(keypoints[i].level) & 0xffU;
  }
}

void FeatureGrid::query(float x, float y, float radius, int min_level, int max_level,
                        std::vector<int>& result) const {
  if (items_.empty() || !(radius >= 0) || !std::isfinite(x + y + radius)) return;
  const int first_column = cell_of(x - radius, kCell, columns_);
  const int last_column = cell_of(x + radius, kCell, columns_);
  const int last_row = cell_of(y + radius, kCell, rows_);
  for (int row = cell_of(y - radius, kCell, rows_); row <= last_row; ++row) {
    // Cells of a row follow each other in items_.
    const auto first = static_cast<std::size_t>(row * columns_ + first_column);
    const auto last = static_cast<std::size_t>(row * columns_ + last_column) + 1;
    for (int i = cell_begin_[first]; i < cell_begin_[last]; ++i) {
      const Item& item = items_[static_cast<std::size_t>(i)];
      const int level = static_cast<int>(item.level);
      if (level < min_level || level > max_level) continue;
      if (std::abs(item.x - x) > radius || std::abs(item.y - y) > radius) continue;
      result.push_back(static_cast<int>(item.index));
    }
  }
}

}  // namespace vinebench::slam
