// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_search.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "slam/tags/black_regions.h"

namespace vinebench::slam {
namespace {

// From 206 images with 95 tags at 0.5 to 4.8 m, up to 65 degrees aslant, dim, noisy and blurred:
// those that AprilTag finds have 10 px at least, miss a quadrilateral by up to 0.78 of what is
// allowed here, and 0.21 or more of their outline are white.
constexpr int kContrast = 15;         // grey levels; a tag that is believed has more, AprilTag's 5
constexpr int kLeastSide = 6;         // px of the smaller image, for 8 modules and more
constexpr int kLeastLength = 8;       // px, of the longer side
constexpr double kRagged = 0.10;      // share of the outline's area missing to a quadrilateral's
constexpr double kEdge = 0.35;        // px of the outline, beside that: edges of pixels are steps
constexpr double kLeastWhite = 0.10;  // share of the outline's area
constexpr int kTile = 4;              // px of the smaller image that AprilTag looks at together
constexpr double kWaste = 1.2;        // of area, that two rectangles may have when made one

cv::Mat every(const cv::Mat& grey, int step) {
  if (step == 1) return grey;
  cv::Mat smaller(1 + (grey.rows - 1) / step, 1 + (grey.cols - 1) / step, CV_8UC1);
  for (int row = 0; row < smaller.rows; ++row) {
    const std::uint8_t* from = grey.ptr<std::uint8_t>(row * step);
    std::uint8_t* to = smaller.ptr<std::uint8_t>(row);
    if (step == 2) {  // what the processor does at once
      for (int x = 0; x < smaller.cols; ++x) to[x] = from[2 * x];
    } else {
      for (int x = 0; x < smaller.cols; ++x) to[x] = from[x * step];
    }
  }
  return smaller;
}

/// The leftmost and rightmost pixel of a region in each of its rows.
struct Outline {
  struct Row {
    int left = 1 << 30;
    int right = -1;
  };
  std::vector<Row> rows;

  double area() const {
    double sum = 0;
    for (const Row& row : rows) sum += row.right - row.left + 1;
    return sum;
  }
  std::vector<cv::Point> hull() const {
    std::vector<cv::Point> corners;
    for (int y = 0; y < static_cast<int>(rows.size()); ++y) {
      const Row& row = rows[static_cast<std::size_t>(y)];
      corners.insert(
          corners.end(),
          {{row.left, y}, {row.left, y + 1}, {row.right + 1, y}, {row.right + 1, y + 1}});
    }
    std::vector<cv::Point> hull;
    cv::convexHull(corners, hull);
    return hull;
  }
};

/// Area of the largest quadrilateral with its corners among those of a convex polygon.
double largest_quadrilateral(const std::vector<cv::Point>& polygon) {
  int largest = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    for (std::size_t j = i + 1; j < polygon.size(); ++j) {
      int most = 0;
      int least = 0;
      for (const cv::Point& p : polygon) {
        const int side = (polygon[j] - polygon[i]).cross(p - polygon[i]);
        most = std::max(most, side);
        least = std::min(least, side);
      }
      largest = std::max(largest, most - least);
    }
  }
  return 0.5 * largest;
}

bool may_have_a_tags_size(const BlackRegion& region, const cv::Size& image) {
  const int width = region.right - region.left + 1;
  const int height = region.bottom - region.top + 1;
  // A tag at the image's edge is not whole.
  const bool inside = region.left > 0 && region.top > 0 && region.right + 1 < image.width &&
                      region.bottom + 1 < image.height;
  return inside && std::min(width, height) >= kLeastSide && std::max(width, height) >= kLeastLength;
}

bool may_be_a_tags_border(const BlackRegion& region, const Outline& outline) {
  const double area = outline.area();
  if (area - region.pixels < kLeastWhite * area) return false;
  const std::vector<cv::Point> hull = outline.hull();
  const double hull_area = cv::contourArea(hull);
  const double slack = kRagged * hull_area + kEdge * cv::arcLength(hull, true);
  return hull_area - area <= slack && hull_area - largest_quadrilateral(hull) <= slack;
}

std::vector<BlackRegion> find_borders(const cv::Mat& smaller) {
  const BlackRegions black = find_black_regions(smaller, kContrast);
  std::vector<int> number(black.regions.size(), -1);
  std::vector<BlackRegion> regions;
  std::vector<Outline> outlines;
  for (std::size_t i = 0; i < number.size(); ++i) {
    const BlackRegion& region = black.regions[i];
    if (!may_have_a_tags_size(region, smaller.size())) continue;
    number[i] = static_cast<int>(regions.size());
    regions.push_back(region);
    outlines.emplace_back().rows.resize(static_cast<std::size_t>(region.bottom - region.top + 1));
  }
  for (const BlackRun& run : black.runs) {
    const int i = number[static_cast<std::size_t>(run.region)];
    if (i < 0) continue;
    const auto at = static_cast<std::size_t>(i);
    Outline::Row& row = outlines[at].rows[static_cast<std::size_t>(run.row - regions[at].top)];
    row.left = std::min(row.left, run.first);
    row.right = std::max(row.right, run.last);
  }
  std::vector<BlackRegion> borders;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (may_be_a_tags_border(regions[i], outlines[i])) borders.push_back(regions[i]);
  }
  return borders;
}

/// The border with what is read around it, on the grid of AprilTag's tiles so that it sees black
/// and white there as in the whole image.
cv::Rect surroundings(const BlackRegion& border, int step, const cv::Size& image) {
  const int longer = std::max(border.right - border.left, border.bottom - border.top) + 1;
  const int around = 2 * kTile + longer / 7;
  const int tile = kTile * step;
  const auto down = [&](int v) { return std::max(0, (v - around) * step / tile * tile); };
  const auto up = [&](int v) { return ((v + around) * step / tile + 1) * tile; };
  return cv::Rect(cv::Point(down(border.left), down(border.top)),
                  cv::Point(up(border.right), up(border.bottom))) &
         cv::Rect({0, 0}, image);
}

/// Makes one of rectangles that overlap, where that spares work.
std::vector<cv::Rect> unite(const std::vector<cv::Rect>& rectangles) {
  std::vector<cv::Rect> united;
  for (cv::Rect next : rectangles) {
    for (auto other = united.begin(); other != united.end();) {
      const cv::Rect both = *other | next;
      if (both.area() > kWaste * std::max(other->area(), next.area()) &&
          both.area() > other->area() + next.area()) {
        ++other;
        continue;
      }
      next = both;
      united.erase(other);
      other = united.begin();
    }
    united.push_back(next);
  }
  return united;
}

}  // namespace

std::vector<cv::Rect> find_tag_candidates(const cv::Mat& grey, int step) {
  std::vector<cv::Rect> rectangles;
  for (const BlackRegion& border : find_borders(every(grey, step))) {
    rectangles.push_back(surroundings(border, step, grey.size()));
  }
  return unite(rectangles);
}

}  // namespace vinebench::slam
