// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_corners.h"

#include <gtest/gtest.h>

#include "tests/support/synthetic_tag.h"

namespace vinebench::slam {
namespace {

using test::SyntheticTag;
using Corners = std::array<Eigen::Vector2d, 4>;

/// A tag of 8 modules of 6.7 px, seen a little aslant.
class TagCornersTest : public testing::Test {
 protected:
  static constexpr double kSize = 0.161;  // m
  static constexpr int kModules = 8;
  static constexpr double kUnrefined = 0.4;

  Corners truth() const {
    Corners corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = lens_.project(T_cam_tag_ * tag_.corner(i));
    return corners;
  }
  /// Each up to a pixel off, in another direction.
  Corners rough() const {
    Corners corners = truth();
    corners[0] += Eigen::Vector2d(0.6, -0.5);
    corners[1] += Eigen::Vector2d(-0.7, -0.3);
    corners[2] += Eigen::Vector2d(0.2, 0.8);
    corners[3] += Eigen::Vector2d(-0.4, 0.4);
    return corners;
  }
  static double worst(const Corners& a, const Corners& b) {
    double worst = 0;
    for (std::size_t i = 0; i < 4; ++i) worst = std::max(worst, (a[i] - b[i]).norm());
    return worst;
  }
  void expect_unrefined(const cv::Mat& image, const Corners& start) const {
    Corners corners = start;
    EXPECT_EQ(refine_tag_corners(image, lens_, kModules, corners), kUnrefined);
    EXPECT_EQ(worst(corners, start), 0);
  }

  SyntheticTag tag_{7, kSize};
  PinholeCamera lens_{640, 480, 400, 400, 319.5, 239.5, {}};
  Pose T_cam_tag_{exp_so3({0.3, 0.2, 0.4}), {0.03, -0.02, 1.2}};
};

TEST_F(TagCornersTest, ComeToTheirPlacesFromAPixelAway) {
  for (const double noise : {0.0, 2.0}) {
    Corners corners = rough();
    const double sigma =
        refine_tag_corners(tag_.render(lens_, T_cam_tag_, noise), lens_, kModules, corners);
    // The image puts edges on twelfths of a pixel: 0.06 px at a corner.
    EXPECT_LT(worst(corners, truth()), 0.1) << noise;
    EXPECT_LT(sigma, 0.1);
    EXPECT_GE(sigma, 0.02);
  }
}

// A pixel that an edge crosses with a share f of white has the code f^(1 / 2.2): on average over f
// that is 1 / (1 + 1 / 2.2) = 0.69 in place of 0.5, so that each edge of white seems 0.19 px
// further out, and a corner, where two sides meet, 0.27 px. Black is no black here, which leaves
// half of it.
TEST_F(TagCornersTest, WhatWhiteSpreadsOverBlackIsMadeGood) {
  T_cam_tag_.translation.z() = 0.6;  // modules of 13 px
  const Corners start = truth();
  Corners plain = start;
  refine_tag_corners(tag_.render(lens_, T_cam_tag_), lens_, kModules, plain);
  const auto side = [](const Corners& corners) { return (corners[1] - corners[0]).norm(); };
  EXPECT_NEAR(side(plain), side(start), 0.05);
  tag_.encode(2.2);
  Corners encoded = start;
  refine_tag_corners(tag_.render(lens_, T_cam_tag_), lens_, kModules, encoded);
  EXPECT_NEAR(side(encoded), side(start), 0.05);
}

TEST_F(TagCornersTest, SidesAreStraightWithoutTheDistortion) {
  lens_.distortion = {-0.2, 0.03, 0, 0};
  T_cam_tag_.translation = {0.5, 0.24, 1.2};  // towards the image's corner
  Corners corners = rough();
  refine_tag_corners(tag_.render(lens_, T_cam_tag_), lens_, kModules, corners);
  EXPECT_LT(worst(corners, truth()), 0.1);
}

// Without noise edges are on twelfths of a pixel, and the border's width scatters by that too: 0.03
// px. Noise of 12 levels makes that 0.06 px, in squares 0.05 px more, and of 20 then 0.09 px.
TEST_F(TagCornersTest, MoreNoiseIsToldByTheirDeviation) {
  Corners clean = rough(), noisy = rough();
  const double low = refine_tag_corners(tag_.render(lens_, T_cam_tag_, 1), lens_, kModules, clean);
  const double high =
      refine_tag_corners(tag_.render(lens_, T_cam_tag_, 20), lens_, kModules, noisy);
  EXPECT_GT(high, 2 * low);
}

TEST_F(TagCornersTest, StayWhereThereIsNoEdgeFromBlackToWhite) {
  const cv::Mat image = tag_.render(lens_, T_cam_tag_);
  expect_unrefined(cv::Mat(image.size(), CV_8UC1, cv::Scalar(110)), rough());
  expect_unrefined(255 - image, rough());
  // A contrast of 190 grey levels, of which a tenth is less than the least of 20.
  expect_unrefined(cv::Mat(0.1 * image), rough());
}

TEST_F(TagCornersTest, StayWhereModulesAreTooSmallForAProfile) {
  // At 3.4 m they have 2.4 px. 0.6 of one to either side, in steps of half a pixel: 1 px.
  T_cam_tag_.translation *= 3.4 / 1.2;
  expect_unrefined(tag_.render(lens_, T_cam_tag_), rough());
}

TEST_F(TagCornersTest, StayWhereTheyWouldMoveFar) {
  Corners far = truth();
  far[2] += Eigen::Vector2d(1.8, 0);  // beyond 1.5 px
  expect_unrefined(tag_.render(lens_, T_cam_tag_), far);
}

TEST_F(TagCornersTest, StayWhereTheTagReachesTheImagesRim) {
  T_cam_tag_.translation.x() = 0.94;  // its right corners are out of the image
  expect_unrefined(tag_.render(lens_, T_cam_tag_), truth());
}

}  // namespace
}  // namespace vinebench::slam
