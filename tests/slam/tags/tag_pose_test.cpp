// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_pose.h"

#include <gtest/gtest.h>

#include "core/util/random.h"
#include "slam/tags/tag_sightings.h"

namespace vinebench::slam {
namespace {

PinholeCamera wide_camera(const std::array<double, 5>& distortion = {}) {
  return {1920, 1080, 733, 733, 959.5, 539.5, distortion};
}

std::array<Eigen::Vector2d, 4> corners_of(const Pose& T_cam_tag, const PinholeCamera& lens,
                                          double size) {
  std::array<Eigen::Vector2d, 4> pixels;
  for (std::size_t i = 0; i < 4; ++i) pixels[i] = lens.project(T_cam_tag * tag_corners(size)[i]);
  return pixels;
}

/// Random poses, 0.3 to 2.5 m ahead, tilted by up to 60 degrees against the view and rotated
/// arbitrarily about it.
Pose draw_pose(RandomSequence& random) {
  const double z = random.uniform(0.3, 2.5);
  const double x = z * random.uniform(-0.8, 0.8);
  const double y = z * random.uniform(-0.5, 0.5);
  const double tilt = random.uniform(0.05, 1.05);
  const double about = random.uniform(-3.1, 3.1);
  const Eigen::Quaterniond turn = exp_so3({0, 0, random.uniform(-3.1, 3.1)});
  return {exp_so3({tilt * std::cos(about), tilt * std::sin(about), 0}) * turn, {x, y, z}};
}

TEST(TagPoseTest, IsExactForExactCorners) {
  RandomSequence random(RandomStream(1, "tag-poses"));
  for (const PinholeCamera& lens : {wide_camera(), wide_camera({-0.05, 0.01, 1e-3, -5e-4})}) {
    for (int i = 0; i < 100; ++i) {
      const Pose truth = draw_pose(random);
      const Pose pose = estimate_tag_pose(corners_of(truth, lens, 0.161), lens, 0.161).T_cam_tag;
      EXPECT_LT((pose.translation - truth.translation).norm(), 1e-7) << i;
      EXPECT_LT(angle_of(pose.rotation.conjugate() * truth.rotation), 1e-6) << i;
    }
  }
}

TEST(TagPoseTest, ScalesWithTheSizeOfTheTag) {
  const Pose truth{exp_so3({0.4, 0.2, 0.1}), {0.1, 0.2, 1.0}};
  const Pose pose =
      estimate_tag_pose(corners_of(truth, wide_camera(), 0.161), wide_camera(), 0.322).T_cam_tag;
  EXPECT_LT((pose.translation - 2 * truth.translation).norm(), 1e-7);
}

TEST(TagPoseTest, OfTheTwoPosesThatASquareHasTheBetterIsTaken) {
  // 0.1 px of noise on a tag seen 59 px wide, tilted by 40 degrees: the mirrored pose is 80 degrees
  // away and off by a few tenths of a pixel.
  RandomSequence random(RandomStream(2, "tag-noise"));
  const Pose truth{exp_so3({0, 0.7, 0}), {0.1, 0.05, 2.0}};
  for (int i = 0; i < 50; ++i) {
    auto corners = corners_of(truth, wide_camera(), 0.161);
    for (Eigen::Vector2d& corner : corners) {
      corner.x() += random.normal(0, 0.1);
      corner.y() += random.normal(0, 0.1);
    }
    const Pose pose = estimate_tag_pose(corners, wide_camera(), 0.161).T_cam_tag;
    EXPECT_LT(angle_of(pose.rotation.conjugate() * truth.rotation), 0.05) << i;
    EXPECT_LT((pose.translation - truth.translation).norm(), 0.02) << i;
  }
}

TEST(TagPoseTest, FarAwayTheTwoPosesCannotBeToldApart) {
  // The mirrored pose differs in how much the near side is larger: s/z sin(tilt) of half a side,
  // 0.08 x 0.6 x 30 px = 1.4 px where the tag is 59 px wide at 2 m, and 0.06 px at 10 m (12 px).
  const auto seen = [](double range, double sigma) {
    const Pose truth{exp_so3({0, 0.6, 0}), {0.1, 0.05, range}};
    return estimate_tag_pose(corners_of(truth, wide_camera(), 0.161), wide_camera(), 0.161, sigma);
  };
  EXPECT_FALSE(seen(2, 0.1).ambiguous);
  EXPECT_TRUE(seen(10, 0.1).ambiguous);
  EXPECT_TRUE(seen(2, 1).ambiguous);
  // Near and in a frontal view the two are one pose.
  const Pose frontal{{1, 0, 0, 0}, {0, 0, 0.5}};
  EXPECT_FALSE(
      estimate_tag_pose(corners_of(frontal, wide_camera(), 0.161), wide_camera(), 0.161, 0.1)
          .ambiguous);
}

TEST(TagPoseTest, FourCornersThatAreNoSquareAreSeen) {
  const Pose truth{exp_so3({0.3, 0.4, 0.2}), {0.1, 0.05, 1.0}};
  auto corners = corners_of(truth, wide_camera(), 0.161);
  EXPECT_TRUE(estimate_tag_pose(corners, wide_camera(), 0.161).square);
  corners[2] += Eigen::Vector2d(8, -5);  // of a side of 110 px
  EXPECT_FALSE(estimate_tag_pose(corners, wide_camera(), 0.161).square);
}

}  // namespace
}  // namespace vinebench::slam
