// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "slam/optimisation/bundle_adjustment.h"
#include "tests/support/synthetic_tag.h"
#include "tests/support/synthetic_texture.h"

namespace vinebench::slam {
namespace {

using test::render_image;
using test::SyntheticTag;
using test::SyntheticTexture;

constexpr double kTagSize = 0.161;  // m
const PinholeCamera kCamera{640, 480, 733, 733, 319.5, 239.5, {}};

bool in_a_candidate(const std::vector<cv::Rect>& candidates, const SyntheticTag& tag,
                    const Pose& T_cam_tag) {
  return std::ranges::any_of(candidates, [&](const cv::Rect& part) {
    for (std::size_t i = 0; i < 4; ++i) {
      // The corner plus the width of the print's white margin: a module, 1/8 of the side.
      const Eigen::Vector2d pixel = kCamera.project(T_cam_tag * (1.25 * tag.corner(i)));
      if (!part.contains(cv::Point2d(pixel.x(), pixel.y()))) return false;
    }
    return true;
  });
}

/// Rotation of a tag about the vertical, degrees, and its distance, m.
class TagSearchTest : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(TagSearchTest, ATagLiesInACandidateSharpBlurredOrDim) {
  const auto [degrees, distance] = GetParam();
  for (const int id : {0, 3, 17, 100}) {
    const SyntheticTag tag(id, kTagSize);
    const Pose pose{
        exp_so3(Eigen::Vector3d(0.1, degrees * std::numbers::pi / 180, 0.2 + 0.4 * (id % 5))),
        {0.013 * (id % 7), -0.02, distance}};
    const cv::Mat sharp = tag.render(kCamera, pose, 2);
    cv::Mat blurred;
    cv::GaussianBlur(sharp, blurred, {}, 1.0);
    cv::Mat dim;
    sharp.convertTo(dim, CV_8UC1, 0.3, 10);  // 76 grey levels between black and white
    for (const cv::Mat& image : {sharp, blurred, dim}) {
      EXPECT_TRUE(in_a_candidate(find_tag_candidates(image, 2), tag, pose)) << "tag " << id;
      EXPECT_TRUE(in_a_candidate(find_tag_candidates(image, 1), tag, pose)) << "tag " << id;
    }
  }
}

// 0.161 m at 4 m are 29 px; at 60 degrees they are half as wide at 2.5 m.
INSTANTIATE_TEST_SUITE_P(Views, TagSearchTest,
                         testing::Values(std::pair(0.0, 0.8), std::pair(0.0, 1.5),
                                         std::pair(5.0, 4.0), std::pair(-35.0, 1.0),
                                         std::pair(45.0, 3.0), std::pair(60.0, 2.5)));

cv::Mat white() {
  return cv::Mat(200, 300, CV_8UC1, cv::Scalar(200));
}

TEST(TagSearch, ABlackFrameIsACandidateAndItsSurroundingsAreWhole) {
  cv::Mat image = white();
  cv::rectangle(image, {100, 80, 64, 64}, 30, cv::FILLED);
  cv::rectangle(image, {116, 96, 32, 32}, 200, cv::FILLED);
  const std::vector<cv::Rect> found = find_tag_candidates(image, 2);
  ASSERT_EQ(found.size(), 1u);
  // Two of the tiles of 8 px around, and a seventh of the frame.
  EXPECT_EQ(found[0] & cv::Rect(76, 56, 112, 112), cv::Rect(76, 56, 112, 112));
  EXPECT_LT(found[0].area(), 140 * 140);
  EXPECT_EQ(found[0].x % 8, 0);
  EXPECT_EQ(found[0].y % 8, 0);
}

TEST(TagSearch, WhatIsNoFrameIsNoCandidate) {
  cv::Mat solid = white();
  cv::rectangle(solid, {100, 80, 64, 64}, 30, cv::FILLED);
  cv::Mat ring = white();
  cv::circle(ring, {130, 100}, 40, 30, 16);
  cv::Mat angle = white();
  cv::rectangle(angle, {100, 80, 64, 14}, 30, cv::FILLED);
  cv::rectangle(angle, {100, 80, 14, 64}, 30, cv::FILLED);
  cv::Mat cut = white();
  cv::rectangle(cut, {-20, 80, 64, 64}, 30, 16);
  for (const cv::Mat& image : {ring, angle, cut, white()}) {
    EXPECT_TRUE(find_tag_candidates(image, 2).empty());
  }
  // The inside of a large square without contrast is neither black nor white: it looks like a
  // frame.
  EXPECT_EQ(find_tag_candidates(solid, 2).size(), 1u);
  EXPECT_TRUE(find_tag_candidates(solid, 8).empty());
}

TEST(TagSearch, LittleOfATextureIsLeft) {
  const cv::Mat image = render_image(640, 480, SyntheticTexture(3), 2, 1);
  int area = 0;
  for (const cv::Rect& part : find_tag_candidates(image, 2)) area += part.area();
  EXPECT_LT(area, image.rows * image.cols / 3);
}

}  // namespace
}  // namespace vinebench::slam
