// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/fast_cells.h"

#include <algorithm>

namespace vinebench::slam {
namespace {

/// Of each pixel from 0 to `length` - 1 the cell, where `count` cells divide the length evenly.
std::vector<int> cells_along(int length, int count) {
  std::vector<int> cells(static_cast<std::size_t>(length));
  for (int cell = 0; cell < count; ++cell) {
    std::fill(cells.begin() + cell * length / count, cells.begin() + (cell + 1) * length / count,
              cell);
  }
  return cells;
}

/// Divides an area into cells of about the wanted side.
class Cells {
 public:
  Cells(const cv::Rect& area, int side)
      : area_(area),
        columns_(std::max(1, area.width / side)),
        rows_(std::max(1, area.height / side)),
        column_of_(cells_along(area.width, columns_)),
        row_of_(cells_along(area.height, rows_)) {}
  std::size_t size() const { return static_cast<std::size_t>(columns_ * rows_); }
  std::size_t index(const Corner& corner) const {
    return static_cast<std::size_t>(row_of_[static_cast<std::size_t>(corner.y - area_.y)] *
                                        columns_ +
                                    column_of_[static_cast<std::size_t>(corner.x - area_.x)]);
  }

 private:
  cv::Rect area_;
  int columns_;
  int rows_;
  std::vector<int> column_of_;
  std::vector<int> row_of_;
};

}  // namespace

std::vector<Corner> detect_fast_cells(const cv::Mat& image, const FastCellsConfig& config) {
  const cv::Rect area(config.edge, config.edge, image.cols - 2 * config.edge,
                      image.rows - 2 * config.edge);
  if (area.width <= 0 || area.height <= 0) return {};
  std::vector<Corner> corners =
      fast_corners(image, area, std::min(config.threshold, config.threshold_min));
  const Cells cells(area, config.cell);
  std::vector<char> strong(cells.size(), 0);
  for (const Corner& corner : corners) {
    if (corner.score >= config.threshold) strong[cells.index(corner)] = 1;
  }
  std::erase_if(corners, [&](const Corner& corner) {
    return corner.score < config.threshold && strong[cells.index(corner)] != 0;
  });
  return corners;
}

}  // namespace vinebench::slam
