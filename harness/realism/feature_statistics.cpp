// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <opencv2/features2d.hpp>

#include "core/util/percentile.h"
#include "harness/realism/picture_statistics.h"

namespace vinebench::harness {
namespace {

constexpr int kCellRows = 10;
constexpr int kCellColumns = 16;
constexpr float kApart = 30;    // px, between descriptors that are compared
constexpr int kLookAlike = 50;  // bits of 256

using Cells = std::array<int, kCellRows * kCellColumns>;

Cells cells_of(const std::vector<cv::KeyPoint>& points, const cv::Size& size) {
  Cells cells{};
  for (const cv::KeyPoint& point : points) {
    const auto row = static_cast<int>(point.pt.y * kCellRows / static_cast<float>(size.height));
    const auto column =
        static_cast<int>(point.pt.x * kCellColumns / static_cast<float>(size.width));
    ++cells[static_cast<std::size_t>(std::clamp(row, 0, kCellRows - 1) * kCellColumns +
                                     std::clamp(column, 0, kCellColumns - 1))];
  }
  return cells;
}

/// Entropy of the features' distribution over the cells, 1 if they are even.
double evenness(const Cells& cells, std::size_t count) {
  double sum = 0;
  for (const int in_cell : cells) {
    const double share = in_cell / static_cast<double>(std::max<std::size_t>(count, 1));
    if (share > 0) sum -= share * std::log(share);
  }
  return sum / std::log(static_cast<double>(cells.size()));
}

int distance(const std::uint8_t* a, const std::uint8_t* b) {
  int bits = 0;
  for (int i = 0; i < 32; ++i) bits += std::popcount(static_cast<unsigned>(a[i] ^ b[i]));
  return bits;
}

/// For each descriptor the distance to the most similar one that is not of the same place.
std::vector<double> nearest_elsewhere(const std::vector<cv::KeyPoint>& points,
                                      const cv::Mat& descriptors) {
  std::vector<double> nearest(points.size(), 999);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const cv::Point2f apart = points[i].pt - points[j].pt;
      if (apart.dot(apart) < kApart * kApart) continue;
      const double bits =
          distance(descriptors.ptr(static_cast<int>(i)), descriptors.ptr(static_cast<int>(j)));
      nearest[i] = std::min(nearest[i], bits);
      nearest[j] = std::min(nearest[j], bits);
    }
  }
  return nearest;
}

void add_corners(const cv::Mat& grey, double area, PictureStatistics& statistics) {
  for (const int threshold : {20, 7}) {
    std::vector<cv::KeyPoint> corners;
    cv::FastFeatureDetector::create(threshold, true)->detect(grey, corners);
    const double count = static_cast<double>(corners.size()) / area;
    statistics.emplace_back(fmt::format("fast{}", threshold), count);
    if (threshold != 20) continue;
    const Cells cells = cells_of(corners, grey.size());
    statistics.emplace_back("fast20_empty_cells",
                            static_cast<double>(std::ranges::count(cells, 0)) / cells.size());
  }
}

void add_look_alikes(const cv::Mat& grey, PictureStatistics& statistics) {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  cv::ORB::create(1000)->detectAndCompute(grey, cv::noArray(), points, descriptors);
  statistics.emplace_back("orb_spread", evenness(cells_of(points, grey.size()), points.size()));
  if (points.size() <= 50) return;
  const std::vector<double> nearest = nearest_elsewhere(points, descriptors);
  const auto alike = std::ranges::count_if(nearest, [](double d) { return d < kLookAlike; });
  statistics.emplace_back("self_d1", percentile(nearest, 0.5));
  statistics.emplace_back("self_lt50", static_cast<double>(alike) / nearest.size());
}

void add_blobs(const cv::Mat& grey, double area, PictureStatistics& statistics) {
  std::vector<cv::KeyPoint> points;
  cv::SIFT::create(0, 3, 0.03)->detect(grey, points);
  std::vector<double> sizes;
  for (const cv::KeyPoint& point : points) sizes.push_back(point.size);
  statistics.emplace_back("sift", static_cast<double>(points.size()) / area);
  statistics.emplace_back("blob_p90", sizes.empty() ? 0 : percentile(sizes, 0.9));
}

}  // namespace

void add_feature_statistics(const cv::Mat& grey, PictureStatistics& statistics) {
  const double area = static_cast<double>(grey.total()) / 1e5;
  add_corners(grey, area, statistics);
  add_look_alikes(grey, statistics);
  add_blobs(grey, area, statistics);
}

}  // namespace vinebench::harness
