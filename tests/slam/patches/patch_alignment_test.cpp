// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/patches/patch_alignment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/synthetic_plane.h"

namespace vinebench::slam {
namespace {

using test::SyntheticPlane;

struct Alignments {
  int tried = 0;
  int found = 0;
  double rms = 0;         ///< px
  double worst = 0;       ///< px
  double difference = 0;  ///< grey levels, mean
};

SyntheticPlane plane(double disparity, double by_x = 0, double by_y = 0) {
  SyntheticPlane p;
  p.at_middle = disparity;
  p.by_x = by_x;
  p.by_y = by_y;
  p.width = 300;
  p.height = 120;
  return p;
}

/// Windows all over the image, each with a guess that is off by up to 2 px.
Alignments align_all(const SyntheticPlane& p, const cv::Mat& left, const cv::Mat& right) {
  Alignments result;
  for (int y = 10; y < p.height - 10; y += 13) {
    for (int x = 100; x < p.width - 12; x += 13) {
      const double truth = p.disparity(x, y);
      const auto aligned = align_patch(left, right, x, y, truth + (x + y) % 5 - 2);
      ++result.tried;
      if (!aligned) continue;
      ++result.found;
      const double error = std::abs(aligned->shift - truth);
      result.rms += error * error;
      result.worst = std::max(result.worst, error);
      result.difference += aligned->difference;
    }
  }
  result.rms = std::sqrt(result.rms / result.found);
  result.difference /= result.found;
  return result;
}

TEST(PatchAlignmentTest, FindsAnyPartOfAPixel) {
  for (const double fraction : {0.0, 0.25, 0.5, 0.8}) {
    const SyntheticPlane p = plane(20 + fraction);
    const Alignments found = align_all(p, p.left(0), p.right(0));
    EXPECT_GT(found.found, found.tried * 95 / 100) << fraction;
    // Quantised grey levels and cubic interpolation of a texture with detail of 4 px.
    EXPECT_LT(found.rms, 0.03) << fraction;
  }
}

TEST(PatchAlignmentTest, BearsTheNoiseOfASensor) {
  const SyntheticPlane p = plane(20.3);
  const Alignments found = align_all(p, p.left(1.5), p.right(1.5));
  EXPECT_GT(found.found, found.tried * 95 / 100);
  EXPECT_LT(found.rms, 0.1);
  // The remaining difference is the noise of both: 0.8 * 1.5 * sqrt(2) = 1.7 grey levels.
  EXPECT_NEAR(found.difference, 1.7, 0.4);
}

TEST(PatchAlignmentTest, FollowsASlantedSurface) {
  for (const double by_x : {-0.15, 0.15}) {
    const SyntheticPlane p = plane(25, by_x, 0.1);
    const Alignments found = align_all(p, p.left(0), p.right(0));
    EXPECT_GT(found.found, found.tried * 9 / 10) << by_x;
    EXPECT_LT(found.rms, 0.1) << by_x;
  }
}

TEST(PatchAlignmentTest, ABrighterCameraChangesNothing) {
  const SyntheticPlane p = plane(20.3);
  const cv::Mat left = p.left(0);
  const cv::Mat right = p.right(0);
  const Alignments same = align_all(p, left, right);
  // The texture is within (40, 215): 30 more saturates nothing.
  const Alignments brighter = align_all(p, left, right + cv::Scalar(30));
  EXPECT_NEAR(brighter.found, same.found, 2);
  EXPECT_LT(brighter.rms, 0.03);
}

TEST(PatchAlignmentTest, TellsContrastAndDifference) {
  // A black and a white half: every pixel is 50 from the mean, except the middle column, 11 of 121.
  cv::Mat left(60, 100, CV_8UC1, cv::Scalar(100));
  left.colRange(0, 50) = 0;
  const auto aligned = align_patch(left, left, 50, 30, 0);
  ASSERT_TRUE(aligned);
  EXPECT_NEAR(aligned->contrast, 50, 0.5);
  EXPECT_NEAR(aligned->difference, 0, 1e-3);
  EXPECT_NEAR(aligned->shift, 0, 1e-3);
}

TEST(PatchAlignmentTest, FindsNothingWhereThereIsNothingToFind) {
  const SyntheticPlane p = plane(20);
  const cv::Mat left = p.left(0);
  const cv::Mat right = p.right(0);
  const cv::Mat flat(p.height, p.width, CV_8UC1, cv::Scalar(90));
  EXPECT_FALSE(align_patch(flat, flat, 150, 60, 0));
  EXPECT_FALSE(align_patch(left, right.rowRange(0, 100), 150, 60, 20));  // another size
  for (const cv::Point at : {cv::Point(5, 60), cv::Point(294, 60), cv::Point(150, 4),
                             cv::Point(150, 115), cv::Point(-5, -5)}) {
    EXPECT_FALSE(align_patch(left, right, at.x, at.y, 0)) << at.x << ", " << at.y;
  }
  // The right window would leave the image.
  EXPECT_FALSE(align_patch(left, right, 20, 60, 20));
}

TEST(PatchAlignmentTest, ALineAlongTheRowHasNoPlaceOnIt) {
  cv::Mat line(60, 100, CV_8UC1, cv::Scalar(30));
  line.rowRange(28, 32) = 200;
  EXPECT_FALSE(align_patch(line, line, 50, 30, 0));
}

}  // namespace
}  // namespace vinebench::slam
