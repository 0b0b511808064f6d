// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_detector.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/error.h"
#include "slam/tags/tag_sightings.h"
#include "tests/support/synthetic_tag.h"

namespace vinebench::slam {
namespace {

using test::SyntheticTag;

constexpr double kSize = 0.161;  // m

PinholeCamera camera(const std::array<double, 5>& distortion = {}) {
  return {640, 480, 400, 400, 319.5, 239.5, distortion};
}

/// A tag 0.6 m ahead, rotated by `rpy` rad about the camera's axes.
Pose before_camera(const Eigen::Vector3d& turn, const Eigen::Vector3d& at = {0.05, -0.03, 0.6}) {
  return {exp_so3(turn), at};
}

/// Largest error of a corner, px.
double worst_corner(const TagSighting& sighting, const SyntheticTag& tag, const PinholeCamera& lens,
                    const Pose& T_cam_tag) {
  double worst = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d truth = lens.project(T_cam_tag * tag.corner(i));
    worst = std::max(worst, (sighting.corners[i] - truth).norm());
  }
  return worst;
}

TEST(TagDetectorTest, FindsCornersToATenthOfAPixelAndThePose) {
  const SyntheticTag tag(7, kSize);
  TagDetector detector({}, {});
  for (const Eigen::Vector3d& turn :
       {Eigen::Vector3d(0, 0, 0), {0.4, 0, 0}, {0, -0.5, 0}, {0.2, 0.3, 1.9}, {-0.3, 0.2, 3.1}}) {
    const Pose truth = before_camera(turn);
    const auto sightings = detector.detect(tag.render(camera(), truth, 1.5), camera(), 3);
    ASSERT_EQ(sightings.size(), 1u) << turn.transpose();
    const TagSighting& seen = sightings[0];
    EXPECT_EQ(seen.family, "tag36h11");
    EXPECT_EQ(seen.id, 7);
    EXPECT_EQ(seen.camera, 3);
    // The image itself puts edges on twelfths of a pixel: 0.06 px at a corner.
    EXPECT_LT(worst_corner(seen, tag, camera(), truth), 0.1);
    // On a tag of 107 px that is a thousandth of its distance, and of its direction two hundredths
    // in a frontal view, where it is least observable.
    EXPECT_LT((seen.T_cam_tag.translation - truth.translation).norm(), 0.001);
    EXPECT_LT(angle_of(seen.T_cam_tag.rotation.conjugate() * truth.rotation), 0.02);
  }
}

TEST(TagDetectorTest, CornersAreAsGoodAsTheySay) {
  // Near, far and oblique, with little and much noise: the mean squared error in x and y is one in
  // variances. Eight errors an image, in pairs that share a side and all with the bloom in common,
  // are good to a factor of two; twelve images together to a half. The reported sigma is at least
  // 0.02 px, although the error on a clean image is smaller.
  const SyntheticTag tag(7, kSize);
  TagDetector detector({}, {});
  std::vector<double> sigmas;
  double mean = 0;
  for (const double noise : {4.0, 6.0, 9.0, 12.0}) {
    for (const Pose& truth : {before_camera({0.2, 0.1, 0.3}), before_camera({0, 1.0, 0.2}),
                              before_camera({0.3, 0.1, 0.1}, {0.1, 0.1, 1.5})}) {
      const auto seen = detector.detect(tag.render(camera(), truth, noise), camera(), 0);
      ASSERT_EQ(seen.size(), 1u) << noise << " at " << truth.translation.transpose();
      sigmas.push_back(seen[0].corner_sigma);
      for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector2d error = seen[0].corners[i] - camera().project(truth * tag.corner(i));
        mean += error.squaredNorm() / std::pow(seen[0].corner_sigma, 2) / 96;
      }
    }
  }
  EXPECT_GT(mean, 0.5);
  EXPECT_LT(mean, 1.5);
  for (const std::size_t near : {0, 3, 6, 9}) {
    EXPECT_GT(sigmas[near + 1], sigmas[near]);  // oblique
    EXPECT_GT(sigmas[near + 2], sigmas[near]);  // far
  }
}

TEST(TagDetectorTest, TheTagsFrameHasXRightYDownAndZIntoIt) {
  // In a frontal view its axes are the camera's.
  const Pose truth = before_camera({0, 0, 0}, {0, 0, 0.5});
  TagDetector detector({}, {});
  const auto sightings =
      detector.detect(SyntheticTag(0, kSize).render(camera(), truth), camera(), 0);
  ASSERT_EQ(sightings.size(), 1u);
  EXPECT_LT(angle_of(sightings[0].T_cam_tag.rotation), 0.02);
  // The first corner is the lower left one, the third the upper right.
  const auto& corners = sightings[0].corners;
  EXPECT_LT(corners[0].x(), corners[1].x() - 100);
  EXPECT_GT(corners[0].y(), corners[3].y() + 100);
  EXPECT_GT(corners[2].x(), corners[3].x() + 100);
  // Bundle adjustment uses the same order.
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(tag_corners(kSize)[i], SyntheticTag(0, kSize).corner(i));
  }
}

TEST(TagDetectorTest, ALensWithDistortionIsAllowedFor) {
  const PinholeCamera lens = camera({-0.12, 0.02, 1e-3, -1e-3});
  const SyntheticTag tag(3, kSize);
  const Pose truth = before_camera({0.2, -0.4, 0.1}, {0.25, 0.15, 0.6});
  TagDetector detector({}, {});
  const auto sightings = detector.detect(tag.render(lens, truth), lens, 0);
  ASSERT_EQ(sightings.size(), 1u);
  // Edges are a little bent: the fitted lines meet a little off the corners.
  EXPECT_LT(worst_corner(sightings[0], tag, lens, truth), 0.1);
  EXPECT_LT((sightings[0].T_cam_tag.translation - truth.translation).norm(), 0.003);
  EXPECT_LT(angle_of(sightings[0].T_cam_tag.rotation.conjugate() * truth.rotation), 0.02);
}

TEST(TagDetectorTest, ARegisteredTagHasItsOwnSize) {
  const SyntheticTag large(4, 0.3);
  const Pose truth = before_camera({0.3, 0, 0}, {0, 0, 1.0});
  const cv::Mat image = large.render(camera(), truth);
  TagDetector knows({}, {RegisteredTag{"tag36h11", 4, 0.3, {}}});
  EXPECT_NEAR(knows.detect(image, camera(), 0).at(0).T_cam_tag.translation.z(), 1.0, 0.003);
  TagDetector guesses({}, {RegisteredTag{"tag36h11", 5, 0.3, {}}});
  EXPECT_NEAR(guesses.detect(image, camera(), 0).at(0).T_cam_tag.translation.z(), 0.161 / 0.3,
              0.003);
}

TEST(TagDetectorTest, SightingsAreInOrderOfTheirIds) {
  cv::Mat image =
      SyntheticTag(9, kSize).render(camera(), before_camera({0, 0, 0}, {-0.25, 0, 0.6}));
  SyntheticTag(2, kSize).draw(image, camera(), before_camera({0, 0, 0}, {0.25, 0, 0.6}));
  TagDetector detector({}, {});
  const auto sightings = detector.detect(image, camera(), 0);
  ASSERT_EQ(sightings.size(), 2u);
  EXPECT_EQ(sightings[0].id, 2);
  EXPECT_EQ(sightings[1].id, 9);
}

TEST(TagDetectorTest, TwoOfOneIdNearEachOtherAreBothSeenAndOnce) {
  // 60 px apart, 40 px wide: their surroundings overlap.
  const SyntheticTag tag(9, 0.06);
  cv::Mat image = tag.render(camera(), before_camera({0, 0, 0}, {-0.045, 0, 0.6}));
  const cv::Mat other = tag.render(camera(), before_camera({0, 0, 0}, {0.045, 0, 0.6}));
  other.copyTo(image, other != 110);  // except the background
  TagDetector detector({}, {});
  const auto sightings = detector.detect(image, camera(), 0);
  ASSERT_EQ(sightings.size(), 2u);
  EXPECT_LT(sightings[0].corners[0].x() + 50, sightings[1].corners[0].x());
}

TEST(TagDetectorTest, AFaintTagIsNotBelieved) {
  const cv::Mat bright = SyntheticTag(1, kSize).render(camera(), before_camera({0.2, 0, 0}));
  cv::Mat faint;
  bright.convertTo(faint, CV_8UC1, 0.15, 90);  // 28 grey levels between black and white
  TagDetectorConfig config;
  EXPECT_TRUE(TagDetector(config, {}).detect(faint, camera(), 0).empty());
  config.min_margin = 1;
  EXPECT_EQ(TagDetector(config, {}).detect(faint, camera(), 0).size(), 1u);
}

TEST(TagDetectorTest, OnlyTheChosenFamiliesAreLookedFor) {
  const cv::Mat image = SyntheticTag(1, kSize).render(camera(), before_camera({0.2, 0, 0}));
  TagDetectorConfig config;
  config.families = {"tag25h9"};
  EXPECT_TRUE(TagDetector(config, {}).detect(image, camera(), 0).empty());
  config.families = {"tag25h9", "tag36h11"};
  EXPECT_EQ(TagDetector(config, {}).detect(image, camera(), 0).size(), 1u);
}

TEST(TagDetectorTest, AnUnknownFamilyIsAnErrorThatListsTheKnownOnes) {
  TagDetectorConfig config;
  config.families = {"tag36h12"};
  EXPECT_THAT([&] { TagDetector(config, {}); },
              testing::ThrowsMessage<Error>(testing::AllOf(
                  testing::HasSubstr("'tag36h12'"), testing::HasSubstr("tag16h5"),
                  testing::HasSubstr("tag36h11"), testing::HasSubstr("tagStandard41h12"))));
}

TEST(TagDetectorTest, OnlyGreyImagesAreRead) {
  TagDetector detector({}, {});
  EXPECT_THAT([&] { detector.detect(cv::Mat(480, 640, CV_8UC3), camera(), 0); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("expected a grey image")));
  EXPECT_THAT([&] { detector.detect(cv::Mat(), camera(), 0); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("expected a grey image")));
  EXPECT_TRUE(detector.detect(cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)), camera(), 0).empty());
}

}  // namespace
}  // namespace vinebench::slam
