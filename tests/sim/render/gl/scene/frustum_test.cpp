// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/scene/frustum.h"

#include <gtest/gtest.h>

#include "core/geometry/pose.h"

namespace vinebench::sim {
namespace {

/// A camera whose rays span x / z of -1 to 1 and y / z of -0.5 to 0.5.
PinholeCamera camera() {
  return {200, 100, 100, 100, 99.5, 49.5, {}};
}

TEST(ClipFromCamTest, APointLandsOnItsPixel) {
  const PinholeCamera off_centre{200, 100, 150, 130, 70, 60, {}};
  const Eigen::Vector3d p_cam(0.3, -0.1, 2);
  const Eigen::Vector4d clip = clip_from_cam(off_centre) * p_cam.homogeneous();
  // OpenGL's window spans -1 to 1; a pixel's centre lies half a pixel into it.
  const Eigen::Vector2d pixel = off_centre.project(p_cam);
  EXPECT_NEAR(clip.x() / clip.w(), 2 * (pixel.x() + 0.5) / 200 - 1, 1e-12);
  EXPECT_NEAR(clip.y() / clip.w(), 2 * (pixel.y() + 0.5) / 100 - 1, 1e-12);
}

TEST(ClipFromCamTest, DepthsGoFromTheNearPlaneToTheFarOne) {
  for (const auto& [z, depth] : {std::pair(kNearPlane, -1.0), {kFarPlane, 1.0}}) {
    const Eigen::Vector4d clip = clip_from_cam(camera()) * Eigen::Vector4d(0, 0, z, 1);
    EXPECT_NEAR(clip.z() / clip.w(), depth, 1e-12);
  }
}

TEST(FrustumTest, ABallIsSeenWhereItReachesIntoView) {
  const Frustum frustum(camera());
  // At z = 2 the right border is at x = 2, slanted by 45 degrees: a ball at x = 3 is sqrt(0.5)
  // from it.
  EXPECT_TRUE(frustum.may_see(Eigen::Vector3d(3, 0, 2), 0.72));
  EXPECT_FALSE(frustum.may_see(Eigen::Vector3d(3, 0, 2), 0.70));
  EXPECT_TRUE(frustum.may_see(Eigen::Vector3d(0, 0.9, 2), 0.0));
  EXPECT_FALSE(frustum.may_see(Eigen::Vector3d(0, 1.1, 2), 0.05));
  EXPECT_FALSE(frustum.may_see(Eigen::Vector3d(0, 0, -2), 1.9));
  EXPECT_FALSE(frustum.may_see(Eigen::Vector3d(0, 0, 210), 9));
  EXPECT_TRUE(frustum.may_see(Eigen::Vector3d(0, 0, 210), 11));
}

TEST(FrustumTest, ABoxIsSeenWhereItIsPlaced) {
  const Frustum frustum(camera());
  const Eigen::AlignedBox3f box(Eigen::Vector3f(-0.1f, -0.1f, -1), Eigen::Vector3f(0.1f, 0.1f, 1));
  const auto placed = [&](const Eigen::Vector3d& turn, const Eigen::Vector3d& at) {
    return frustum.may_see(box, Pose{exp_so3(turn), at}.matrix());
  };
  EXPECT_TRUE(placed({0, 0, 0}, {0, 0, 3}));
  EXPECT_FALSE(placed({0, 0, 0}, {0, 0, -3}));
  // Upright at y = 1.8, z = 2 it ends 0.7 beyond the border at y = 1; along y it reaches to 0.8.
  EXPECT_FALSE(placed({0, 0, 0}, {0, 1.8, 1}));
  EXPECT_TRUE(placed({1.5707963, 0, 0}, {0, 1.8, 2}));
}

TEST(FrustumTest, AHullAroundTheViewIsSeen) {
  const Frustum frustum(camera());
  // No corner is in view, but what lies between them crosses it.
  EXPECT_TRUE(frustum.may_see({{-9, 0, 3}, {9, 0, 3}}));
  EXPECT_FALSE(frustum.may_see({{-9, 0, 3}, {-4, 1, 3}, {-4, -1, 2}}));
  EXPECT_FALSE(frustum.may_see(std::vector<Eigen::Vector3d>{}));
}

}  // namespace
}  // namespace vinebench::sim
