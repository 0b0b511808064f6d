// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/fast_cells.h"

#include <algorithm>
#include <opencv2/features2d.hpp>

namespace vinebench::slam {
namespace {

/// FAST looks 3 px around, and the suppression of non-maxima one further.
constexpr int kBorder = 4;

/// Appends the corners that lie in `area`.
void detect(const cv::Mat& image, const cv::Rect& area, int threshold,
            std::vector<Corner>& corners) {
  const cv::Rect wide = cv::Rect(area.x - kBorder, area.y - kBorder, area.width + 2 * kBorder,
                                 area.height + 2 * kBorder) &
                        cv::Rect(0, 0, image.cols, image.rows);
  std::vector<cv::KeyPoint> found;
  cv::FAST(image(wide), found, threshold, true, cv::FastFeatureDetector::TYPE_9_16);
  for (const cv::KeyPoint& point : found) {
    const cv::Point at(static_cast<int>(point.pt.x) + wide.x,
                       static_cast<int>(point.pt.y) + wide.y);
    if (area.contains(at)) corners.push_back({at.x, at.y, static_cast<int>(point.response)});
  }
}

/// Divides an area evenly into cells of about the wanted side.
struct Cells {
  cv::Rect area;
  int columns;
  int rows;

  Cells(const cv::Rect& a, int side)
      : area(a), columns(std::max(1, a.width / side)), rows(std::max(1, a.height / side)) {}
  int left(int column) const { return area.x + column * area.width / columns; }
  int top(int row) const { return area.y + row * area.height / rows; }
  /// Inverse of left() and top(): the last cell that begins at or before the point.
  std::size_t index(int x, int y) const {
    const int column = ((x - area.x + 1) * columns - 1) / area.width;
    const int row = ((y - area.y + 1) * rows - 1) / area.height;
    return static_cast<std::size_t>(row * columns + column);
  }
  cv::Rect run(int row, int first, int last) const {
    return {cv::Point(left(first), top(row)), cv::Point(left(last), top(row + 1))};
  }
};

/// Searches again, less strictly, every run of neighbouring cells that have no corner yet.
void fill_empty_cells(const cv::Mat& image, const Cells& cells, int threshold,
                      std::vector<Corner>& corners) {
  std::vector<char> taken(static_cast<std::size_t>(cells.columns * cells.rows), 0);
  for (const Corner& corner : corners) taken[cells.index(corner.x, corner.y)] = 1;
  const auto empty = [&](int row, int column) {
    return taken[static_cast<std::size_t>(row * cells.columns + column)] == 0;
  };
  for (int row = 0; row < cells.rows; ++row) {
    for (int first = 0; first < cells.columns; ++first) {
      int last = first;
      while (last < cells.columns && empty(row, last)) ++last;
      if (last > first) detect(image, cells.run(row, first, last), threshold, corners);
      first = last;
    }
  }
}

}  // namespace

std::vector<Corner> detect_fast_cells(const cv::Mat& image, const FastCellsConfig& config) {
  const cv::Rect area(config.edge, config.edge, image.cols - 2 * config.edge,
                      image.rows - 2 * config.edge);
  std::vector<Corner> corners;
  if (area.width <= 0 || area.height <= 0) return corners;
  detect(image, area, config.threshold, corners);
  if (config.threshold_min < config.threshold) {
    fill_empty_cells(image, Cells(area, config.cell), config.threshold_min, corners);
  }
  return corners;
}

}  // namespace vinebench::slam
