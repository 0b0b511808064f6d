// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/fast_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <opencv2/features2d.hpp>
#include <utility>

#include "tests/support/synthetic_texture.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticTexture;

/// Contrast of the texture falls from full at the left to a tenth at the right.
cv::Mat fading_image() {
  const SyntheticTexture texture(11);
  return render_image(320, 200, [&](double x, double y) {
    return 127 + (texture(x, y) - 127) * (1 - 0.9 * x / 320);
  });
}

/// The definition, cell by cell, from one pass at the low threshold: a cell keeps the corners of
/// the high threshold, or all where it has none.
std::map<std::pair<int, int>, int> by_definition(const cv::Mat& image,
                                                 const FastCellsConfig& config) {
  std::vector<cv::KeyPoint> all;
  cv::FAST(image, all, config.threshold_min, true);
  const int width = image.cols - 2 * config.edge;
  const int height = image.rows - 2 * config.edge;
  const int columns = width / config.cell;
  const int rows = height / config.cell;
  std::map<std::pair<int, int>, int> kept;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const cv::Rect cell(
          cv::Point(config.edge + column * width / columns, config.edge + row * height / rows),
          cv::Point(config.edge + (column + 1) * width / columns,
                    config.edge + (row + 1) * height / rows));
      std::vector<cv::KeyPoint> inside;
      for (const cv::KeyPoint& k : all) {
        if (cell.contains(k.pt)) inside.push_back(k);
      }
      const bool strong = std::any_of(inside.begin(), inside.end(), [&](const cv::KeyPoint& k) {
        return static_cast<int>(k.response) >= config.threshold;
      });
      for (const cv::KeyPoint& k : inside) {
        const int score = static_cast<int>(k.response);
        if (!strong || score >= config.threshold) kept[{cvRound(k.pt.y), cvRound(k.pt.x)}] = score;
      }
    }
  }
  return kept;
}

TEST(FastCells, AgreesWithTheDefinition) {
  const cv::Mat image = fading_image();
  for (const int cell : {20, 32, 47}) {
    const FastCellsConfig config{20, 7, cell, 19};
    std::map<std::pair<int, int>, int> found;
    for (const Corner& c : detect_fast_cells(image, config)) found[{c.y, c.x}] = c.score;
    EXPECT_EQ(found, by_definition(image, config)) << "cells of " << cell << " px";
  }
}

TEST(FastCells, WeakCellsGiveCornersOnlyByTheLowerThreshold) {
  const cv::Mat image = fading_image();
  const auto right_part = [&](int threshold_min) {
    const auto corners = detect_fast_cells(image, {20, threshold_min, 32, 19});
    return std::count_if(corners.begin(), corners.end(),
                         [](const Corner& c) { return c.x > 280 && c.score < 20; });
  };
  EXPECT_EQ(right_part(20), 0);
  EXPECT_GT(right_part(5), 5);
}

TEST(FastCells, LeavesTheBorderOut) {
  for (const Corner& c : detect_fast_cells(fading_image(), {20, 7, 32, 30})) {
    EXPECT_GE(c.x, 30);
    EXPECT_GE(c.y, 30);
    EXPECT_LT(c.x, 320 - 30);
    EXPECT_LT(c.y, 200 - 30);
  }
}

TEST(FastCells, BlankOrTinyImagesHaveNone) {
  EXPECT_TRUE(detect_fast_cells(cv::Mat(200, 300, CV_8UC1, cv::Scalar(90)), {}).empty());
  EXPECT_TRUE(detect_fast_cells(cv::Mat(38, 300, CV_8UC1, cv::Scalar(90)), {}).empty());
  EXPECT_TRUE(detect_fast_cells(cv::Mat(1, 1, CV_8UC1, cv::Scalar(90)), {}).empty());
}

}  // namespace
}  // namespace vinebench::slam
