// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/truth/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/world/world_layout.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using test::look_at;

constexpr auto kTag = static_cast<std::uint8_t>(Label::kTag);

TEST(LabelShareTest, CountsPixels) {
  cv::Mat labels(10, 20, CV_8UC1, cv::Scalar(static_cast<int>(Label::kGround)));
  labels(cv::Rect(0, 0, 5, 10)) = static_cast<int>(Label::kBox);
  EXPECT_DOUBLE_EQ(label_share(labels, Label::kBox), 0.25);
  EXPECT_DOUBLE_EQ(label_share(labels, Label::kGround), 0.75);
  EXPECT_DOUBLE_EQ(label_share(labels, Label::kTag), 0);
  EXPECT_DOUBLE_EQ(label_share(cv::Mat(), Label::kBox), 0);
  // A part of an image is not continuous in memory.
  EXPECT_DOUBLE_EQ(label_share(labels(cv::Rect(0, 0, 10, 10)), Label::kBox), 0.5);
}

TEST(OcclusionInTest, CountsEachClassOfTheWorldForItself) {
  cv::Mat labels(10, 20, CV_8UC1, cv::Scalar(static_cast<int>(Label::kGround)));
  labels(cv::Rect(0, 0, 5, 10)) = static_cast<int>(Label::kPerson);
  labels(cv::Rect(5, 0, 2, 10)) = static_cast<int>(Label::kCrate);
  WorldConfig world;
  world.occluders.resize(3);
  world.occluders[0].shape = Occluder::Shape::kPerson;
  world.occluders[1].shape = Occluder::Shape::kCrate;
  world.occluders[2].shape = Occluder::Shape::kPerson;
  const std::vector<OccluderClass> classes = occluder_classes(world);
  EXPECT_EQ(classes, (std::vector{OccluderClass::kCrate, OccluderClass::kPerson}));
  const Occlusion seen = occlusion_in(labels, classes);
  EXPECT_DOUBLE_EQ(seen.share(OccluderClass::kPerson), 0.25);
  EXPECT_DOUBLE_EQ(seen.share(OccluderClass::kCrate), 0.1);
  EXPECT_DOUBLE_EQ(seen.share(OccluderClass::kCarton), 0);
  EXPECT_DOUBLE_EQ(seen.total(), 0.35);
}

/// A tag of 0.2 m at (0, 0, 1) that faces -y, in front of a camera of 752 x 480 with f = 263 px.
class TagVisibleTest : public testing::Test {
 protected:
  TagVisibleTest() {
    tag_.size = 0.2;
    tag_.T_world_tag = tag_pose({{0, 0, 1}, -90, 0});
  }

  /// All pixels have the tag's label unless a test changes it.
  bool visible(const Pose& T_world_cam) const {
    return is_tag_visible(tag_, camera_, T_world_cam, labels_);
  }

  WorldTag tag_;
  PinholeCamera camera_ = test::small_camera();
  cv::Mat labels_ = cv::Mat(480, 752, CV_8UC1, cv::Scalar(kTag));
};

TEST_F(TagVisibleTest, InView) {
  EXPECT_TRUE(visible(look_at({0, -1, 1}, {0, 0, 1})));
  EXPECT_TRUE(visible(look_at({0.5, -0.8, 1.2}, {0, 0, 1}, 0.5)));
}

TEST_F(TagVisibleTest, OutOfView) {
  EXPECT_FALSE(visible(look_at({0, -1, 1}, {0, -2, 1})));  // behind the camera
  EXPECT_FALSE(visible(look_at({0, -1, 1}, {3, 0, 1})));   // beside the image
}

TEST_F(TagVisibleTest, CutByTheImagesEdge) {
  // 1 m away, the half width of 375.5 px is 1.43 m: the square's far side is at the camera's
  // offset + 0.1 m.
  const auto beside = [&](double offset) {
    return visible(look_at({-offset, -1, 1}, {-offset, 0, 1}));
  };
  EXPECT_TRUE(beside(1.31));   // 371 px
  EXPECT_FALSE(beside(1.34));  // 379 px
}

TEST_F(TagVisibleTest, FromBehindAndAlmostEdgeOn) {
  EXPECT_FALSE(visible(look_at({0, 1, 1}, {0, 0, 1})));
  const auto from = [&](double degrees) {
    const double a = degrees * 3.14159265358979 / 180;
    return is_tag_visible(tag_, camera_, look_at({std::sin(a), -std::cos(a), 1.0}, {0, 0, 1}),
                          labels_, 1);
  };
  EXPECT_TRUE(from(74));
  EXPECT_FALSE(from(76));
}

TEST_F(TagVisibleTest, TooSmallToCount) {
  // 0.2 m at 263.28 px: 24 px at 2.194 m.
  EXPECT_TRUE(visible(look_at({0, -2.1, 1}, {0, 0, 1})));
  EXPECT_FALSE(visible(look_at({0, -2.3, 1}, {0, 0, 1})));
}

TEST_F(TagVisibleTest, OccludedAtItsCentreOrACorner) {
  const Pose pose = look_at({0, -1, 1}, {0, 0, 1});
  const auto cover = [&](const cv::Point& at) {
    labels_.setTo(kTag);
    cv::circle(labels_, at, 4, cv::Scalar(static_cast<int>(Label::kLeaf)), cv::FILLED);
    return visible(pose);
  };
  // 1 m away: the square reaches 26.3 px from the image's middle (375.5, 239.5), its checked
  // corners 25 px.
  EXPECT_FALSE(cover({375, 239}));
  EXPECT_FALSE(cover({375 - 25, 239 - 25}));
  EXPECT_FALSE(cover({375 + 25, 239 - 25}));
  EXPECT_FALSE(cover({375 + 25, 239 + 25}));
  EXPECT_FALSE(cover({375 - 25, 239 + 25}));
  EXPECT_TRUE(cover({375 + 40, 239}));  // beside it
}

}  // namespace
}  // namespace vinebench::sim
