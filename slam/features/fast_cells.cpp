// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/fast_cells.h"

#include <algorithm>

namespace vinebench::slam {
namespace {

/// Divides an area evenly into cells of about the wanted side.
struct Cells {
  cv::Rect area;
  int columns;
  int rows;

  Cells(const cv::Rect& a, int side)
      : area(a), columns(std::max(1, a.width / side)), rows(std::max(1, a.height / side)) {}
  /// The last cell that begins at or before the point; column c begins at area.x + c width /
  /// columns.
  std::size_t index(int x, int y) const {
    const int column = ((x - area.x + 1) * columns - 1) / area.width;
    const int row = ((y - area.y + 1) * rows - 1) / area.height;
    return static_cast<std::size_t>(row * columns + column);
  }
};

}  // namespace

std::vector<Corner> detect_fast_cells(const cv::Mat& image, const FastCellsConfig& config) {
  const cv::Rect area(config.edge, config.edge, image.cols - 2 * config.edge,
                      image.rows - 2 * config.edge);
  if (area.width <= 0 || area.height <= 0) return {};
  std::vector<Corner> corners =
      fast_corners(image, area, std::min(config.threshold, config.threshold_min));
  const Cells cells(area, config.cell);
  std::vector<char> strong(static_cast<std::size_t>(cells.columns * cells.rows), 0);
  for (const Corner& corner : corners) {
    if (corner.score >= config.threshold) strong[cells.index(corner.x, corner.y)] = 1;
  }
  std::erase_if(corners, [&](const Corner& corner) {
    return corner.score < config.threshold && strong[cells.index(corner.x, corner.y)] != 0;
  });
  return corners;
}

}  // namespace vinebench::slam
