// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/black_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "tests/support/synthetic_texture.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticTexture;

/// '#' is black, '.' white.
cv::Mat drawn(const std::vector<std::string>& rows) {
  cv::Mat image(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()), CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const bool black = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#';
      image.at<std::uint8_t>(y, x) = black ? 40 : 200;
    }
  }
  return image;
}

TEST(BlackRegions, AreJoinedAlongRowsAndColumnsButNotCornerwise) {
  const BlackRegions found = find_black_regions(drawn({"#..#....",  //
                                                       "#..#..#.",  //
                                                       "####...#",  //
                                                       "........"}),
                                                20);
  ASSERT_EQ(found.regions.size(), 3u);
  const BlackRegion& u = found.regions[0];
  EXPECT_EQ(u.left, 0);
  EXPECT_EQ(u.right, 3);
  EXPECT_EQ(u.top, 0);
  EXPECT_EQ(u.bottom, 2);
  EXPECT_EQ(u.pixels, 8);
  EXPECT_EQ(found.regions[1].pixels, 1);
  EXPECT_EQ(found.regions[2].pixels, 1);
  EXPECT_EQ(found.runs.size(), 7u);
}

TEST(BlackRegions, AgreeWithTheDefinition) {
  constexpr int kContrast = 30;
  // Neither side is a multiple of the tiles' 4 px.
  const cv::Mat image = render_image(123, 78, SyntheticTexture(5), 3, 2);
  cv::Mat black = cv::Mat::zeros(image.size(), CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const int column = std::min(x / 4, image.cols / 4 - 1);
      const int row = std::min(y / 4, image.rows / 4 - 1);
      const cv::Rect around = cv::Rect(4 * column - 4, 4 * row - 4, 12, 12) &
                              cv::Rect(0, 0, image.cols / 4 * 4, image.rows / 4 * 4);
      double low = 0;
      double high = 0;
      cv::minMaxLoc(image(around), &low, &high);
      const int middle = static_cast<int>(low) + static_cast<int>(high - low) / 2;
      black.at<std::uint8_t>(y, x) =
          high - low >= kContrast && image.at<std::uint8_t>(y, x) <= middle ? 255 : 0;
    }
  }
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centres;
  const int count = cv::connectedComponentsWithStats(black, labels, stats, centres, 4, CV_32S);
  const BlackRegions found = find_black_regions(image, kContrast);
  ASSERT_GT(count, 20);
  ASSERT_EQ(static_cast<int>(found.regions.size()), count - 1);
  for (const BlackRun& run : found.runs) {
    const int label = labels.at<int>(run.row, run.first);
    ASSERT_GT(label, 0);
    const BlackRegion& region = found.regions[static_cast<std::size_t>(run.region)];
    EXPECT_EQ(region.left, stats.at<int>(label, cv::CC_STAT_LEFT));
    EXPECT_EQ(region.top, stats.at<int>(label, cv::CC_STAT_TOP));
    EXPECT_EQ(region.right - region.left + 1, stats.at<int>(label, cv::CC_STAT_WIDTH));
    EXPECT_EQ(region.bottom - region.top + 1, stats.at<int>(label, cv::CC_STAT_HEIGHT));
    EXPECT_EQ(region.pixels, stats.at<int>(label, cv::CC_STAT_AREA));
  }
}

TEST(BlackRegions, FlatAndTinyImagesHaveNone) {
  EXPECT_TRUE(find_black_regions(cv::Mat(40, 40, CV_8UC1, cv::Scalar(0)), 5).runs.empty());
  EXPECT_TRUE(find_black_regions(drawn({"#.", ".#"}), 5).runs.empty());
  // 160 grey levels of contrast, one less than required.
  EXPECT_TRUE(find_black_regions(drawn({"####....", "####....", "####....", "####...."}), 161)
                  .regions.empty());
}

}  // namespace
}  // namespace vinebench::slam
