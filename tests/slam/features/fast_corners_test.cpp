// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/fast_corners.h"

#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>
#include <ostream>
#include <vector>

#include "core/util/random.h"
#include "slam/features/smoothing.h"
#include "tests/support/synthetic_texture.h"
#include "tests/support/vector_kinds.h"

namespace vinebench::slam {

bool operator==(const Corner& a, const Corner& b) {
  return a.x == b.x && a.y == b.y && a.score == b.score;
}

std::ostream& operator<<(std::ostream& out, const Corner& c) {
  return out << "(" << c.x << ", " << c.y << ": " << c.score << ")";
}

namespace {

using test::render_image;
using test::SyntheticTexture;

cv::Mat noise(int width, int height, int seed) {
  RandomSequence draws(RandomStream(static_cast<std::uint64_t>(seed), "noise"));
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(draws.below(256));
    }
  }
  return image;
}

/// OpenCV's, which are in the order of rows and columns, within `area`.
std::vector<Corner> expected(const cv::Mat& image, const cv::Rect& area, int least) {
  std::vector<cv::KeyPoint> all;
  cv::FAST(image, all, least, true, cv::FastFeatureDetector::TYPE_9_16);
  std::vector<Corner> corners;
  for (const cv::KeyPoint& point : all) {
    const cv::Point at(static_cast<int>(point.pt.x), static_cast<int>(point.pt.y));
    if (area.contains(at)) corners.push_back({at.x, at.y, static_cast<int>(point.response)});
  }
  return corners;
}

cv::Rect whole(const cv::Mat& image) {
  return {0, 0, image.cols, image.rows};
}

TEST(FastCorners, AreThoseOfOpenCv) {
  const cv::Mat texture = render_image(320, 200, SyntheticTexture(11));
  for (const cv::Mat& image : {texture, noise(320, 200, 1)}) {
    for (const int least : {1, 7, 20, 35}) {
      const std::vector<Corner> corners = fast_corners(image, whole(image), least);
      EXPECT_GT(corners.size(), 5U) << least;
      EXPECT_EQ(corners, expected(image, whole(image), least)) << least;
    }
  }
}

TEST(FastCorners, AnySizePitchAndAreaWillDo) {
  const cv::Mat image = noise(150, 60, 2);
  for (int width = 1; width <= 140; ++width) {
    const cv::Mat part = image(cv::Rect(3, 5, width, 1 + width % 20));
    EXPECT_EQ(fast_corners(part, whole(part), 5), expected(part.clone(), whole(part), 5)) << width;
  }
  for (const cv::Rect& area : {cv::Rect(40, 20, 17, 9), cv::Rect(2, 0, 90, 40),
                               cv::Rect(140, 50, 90, 90), cv::Rect(50, 30, 1, 1)}) {
    EXPECT_EQ(fast_corners(image, area, 5), expected(image, area, 5)) << area;
  }
}

TEST(FastCorners, ScoreIsTheHighestThreshold) {
  // A pixel of 40 among others of 100: the circle is brighter by 60, which 59 still is below.
  cv::Mat image(9, 9, CV_8UC1, cv::Scalar(100));
  image.at<std::uint8_t>(4, 4) = 40;
  EXPECT_EQ(fast_corners(image, whole(image), 59), (std::vector<Corner>{{4, 4, 59}}));
  EXPECT_TRUE(fast_corners(image, whole(image), 60).empty());
}

TEST(FastCorners, EightInARowAreNone) {
  // Seven of the circle are above the middle row, two in it, one at either side.
  for (const int columns : {0, 1, 7}) {
    cv::Mat image(7, 7, CV_8UC1, cv::Scalar(100));
    image.rowRange(0, 3).setTo(200);
    image.row(3).colRange(0, columns).setTo(200);
    image.at<std::uint8_t>(3, 3) = 100;
    EXPECT_EQ(fast_corners(image, whole(image), 50).size(), columns == 7 ? 1U : 0U) << columns;
  }
}

TEST(FastCorners, HighestAndLowestGreyLevelsDoNotOverflow) {
  cv::Mat image(9, 9, CV_8UC1, cv::Scalar(0));
  image.at<std::uint8_t>(4, 4) = 255;
  EXPECT_EQ(fast_corners(image, whole(image), 1), (std::vector<Corner>{{4, 4, 254}}));
  image = ~image;
  EXPECT_EQ(fast_corners(image, whole(image), 1), (std::vector<Corner>{{4, 4, 254}}));
  EXPECT_TRUE(fast_corners(image, whole(image), 255).empty());
}

/// Everything that is compiled for several kinds of vectors.
TEST(FastCorners, AndSmoothingHaveTheSameBitsWithEveryKindOfVectors) {
  const cv::Mat image = noise(333, 90, 3);
  const std::vector<Corner> corners = fast_corners(image, whole(image), 3);
  const cv::Mat smoothed = smooth(image);
  test::with_each_kind_of_vectors([&] {
    EXPECT_EQ(fast_corners(image, whole(image), 3), corners);
    EXPECT_EQ(cv::norm(smooth(image), smoothed, cv::NORM_INF), 0);
  });
}

}  // namespace
}  // namespace vinebench::slam
