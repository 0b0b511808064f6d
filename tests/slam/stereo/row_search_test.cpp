// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/row_search.h"

#include <gtest/gtest.h>

#include <climits>

#include "tests/support/synthetic_plane.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticPlane;
using test::SyntheticTexture;

constexpr int kX = 150;
constexpr int kY = 30;

SyntheticPlane plane(double disparity) {
  SyntheticPlane p;
  p.at_middle = disparity;
  p.width = 300;
  p.height = 60;
  return p;
}

TEST(RowSearchTest, FindsAWholeShiftExactly) {
  const cv::Mat left = plane(37).left(0);
  const cv::Mat right = plane(37).right(0);
  const RowSearch found = search_row(left, kX, kY, right, kX - 100, kX + 1);
  EXPECT_EQ(found.column, kX - 37);
  EXPECT_EQ(found.best, 0);          // the same grey levels, without noise
  EXPECT_GT(found.second, 176 * 5);  // anywhere else the 16 x 11 px differ by far more
}

TEST(RowSearchTest, NeighboursOfTheBestAreNotItsRivals) {
  // Halfway between two columns both fit equally; they are one minimum.
  const RowSearch found =
      search_row(plane(20.5).left(0), kX, kY, plane(20.5).right(0), kX - 60, kX);
  EXPECT_NEAR(found.column, kX - 20.5, 0.6);
  EXPECT_GT(found.second, 2 * found.best);
}

TEST(RowSearchTest, LooksNoFartherThanItIsAsked) {
  const cv::Mat left = plane(37).left(0);
  const cv::Mat right = plane(37).right(0);
  const RowSearch at_end = search_row(left, kX, kY, right, kX - 37, kX);
  EXPECT_EQ(at_end.column, kX - 37);
  const RowSearch short_of_it = search_row(left, kX, kY, right, kX - 36, kX);
  EXPECT_GE(short_of_it.column, kX - 36);
  EXPECT_GT(short_of_it.best, 0);
  // A range of one minimum has no rival.
  EXPECT_EQ(search_row(left, kX, kY, right, kX - 38, kX - 36).second, INT_MAX);
}

TEST(RowSearchTest, ARepeatedPatternHasAnEqualRival) {
  const SyntheticTexture texture(3);
  const auto fence = [&](double x, double y) { return texture(x - 24 * std::floor(x / 24), y); };
  const cv::Mat left = render_image(300, 60, fence);
  const RowSearch found = search_row(left, kX, kY, left, kX - 100, kX);
  EXPECT_EQ(found.best, 0);
  EXPECT_EQ(found.second, 0);
}

TEST(RowSearchTest, RivalsThatDoNotMatterAreLeftOut) {
  const cv::Mat left = plane(37.5).left(0);
  const cv::Mat right = plane(37.5).right(0);
  const RowSearch all = search_row(left, kX, kY, right, kX - 100, kX + 1);
  ASSERT_GT(all.best, 0);
  const double ratio = static_cast<double>(all.second) / all.best;
  for (const double rivalry : {0.0, 1.0, 0.99 * ratio, 1.01 * ratio, 3 * ratio}) {
    const RowSearch some = search_row(left, kX, kY, right, kX - 100, kX + 1, rivalry);
    EXPECT_EQ(some.column, all.column);
    EXPECT_EQ(some.best, all.best);
    EXPECT_EQ(some.second, rivalry < ratio ? INT_MAX : all.second) << rivalry;
  }
}

TEST(RowSearchTest, ReadsTheWholeWindow) {
  // Black images except for one grey pixel in the left: it counts anywhere in the window.
  for (const cv::Point at : {cv::Point(-8, -5), cv::Point(7, 5), cv::Point(0, 0)}) {
    cv::Mat left = cv::Mat::zeros(60, 300, CV_8UC1);
    const cv::Mat right = cv::Mat::zeros(60, 300, CV_8UC1);
    left.at<std::uint8_t>(kY + at.y, kX + at.x) = 9;
    EXPECT_EQ(search_row(left, kX, kY, right, kX - 5, kX).best, 9) << at.x << ", " << at.y;
    left.at<std::uint8_t>(kY + at.y, kX + at.x) = 0;
    left.at<std::uint8_t>(kY + at.y, kX + at.x + (at.x < 0 ? -1 : 8 - at.x)) = 9;
    EXPECT_EQ(search_row(left, kX, kY, right, kX - 5, kX).best, 0) << at.x << ", " << at.y;
  }
}

TEST(RowSearchTest, WindowsOffTheImageAreNotFound) {
  const cv::Mat image = plane(0).left(0);
  for (const cv::Point at : {cv::Point(7, kY), cv::Point(293, kY), cv::Point(kX, 4),
                             cv::Point(kX, 55), cv::Point(-20, kY), cv::Point(kX, 400)}) {
    EXPECT_EQ(search_row(image, at.x, at.y, image, 0, 299).column, -1) << at.x << ", " << at.y;
  }
  for (const cv::Point at : {cv::Point(8, 5), cv::Point(292, 54)}) {
    EXPECT_EQ(search_row(image, at.x, at.y, image, 0, 299).column, at.x) << at.x << ", " << at.y;
  }
  EXPECT_EQ(search_row(image, kX, kY, image, -50, 7).column, -1);
  EXPECT_EQ(search_row(image, kX, kY, image, 293, 400).column, -1);
  EXPECT_EQ(search_row(image, kX, kY, image, 100, 99).column, -1);
}

}  // namespace
}  // namespace vinebench::slam
