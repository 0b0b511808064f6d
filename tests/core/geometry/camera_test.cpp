// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/camera.h"

#include <gtest/gtest.h>

namespace vinebench {
namespace {

PinholeCamera camera(const std::array<double, 4>& distortion = {}) {
  return {752, 480, 263.2786, 260.0, 375.5, 239.5, distortion};
}

TEST(CameraTest, ProjectsAlongTheOpticalAxes) {
  // A point 2 m ahead, 1 m to the right, 0.5 m down.
  const Eigen::Vector2d pixel = camera().project({1, 0.5, 2});
  EXPECT_DOUBLE_EQ(pixel.x(), 375.5 + 263.2786 / 2);
  EXPECT_DOUBLE_EQ(pixel.y(), 239.5 + 260.0 / 4);
}

TEST(CameraTest, TheAxisMeetsThePrincipalPoint) {
  EXPECT_EQ(camera({0.1, -0.2, 0.01, 0.02}).project({0, 0, 3}), Eigen::Vector2d(375.5, 239.5));
}

TEST(CameraTest, DistortionIsBrownConrady) {
  // x = 0.4, y = 0.2: r2 = 0.2, radial = 1 + 0.2 * (0.1 - 0.05 * 0.2) = 1.018
  // x' = 0.4 * 1.018 + 2 * 0.01 * 0.08 + 0.02 * (0.2 + 0.32) = 0.4072 + 0.0016 + 0.0104 = 0.4192
  // y' = 0.2 * 1.018 + 0.01 * (0.2 + 0.08) + 2 * 0.02 * 0.08 = 0.2036 + 0.0028 + 0.0032 = 0.2096
  const Eigen::Vector2d pixel = camera({0.1, -0.05, 0.01, 0.02}).project({0.8, 0.4, 2});
  EXPECT_NEAR(pixel.x(), 375.5 + 263.2786 * 0.4192, 1e-10);
  EXPECT_NEAR(pixel.y(), 239.5 + 260.0 * 0.2096, 1e-10);
}

TEST(CameraTest, UnprojectUndoesProjectAllOverTheImage) {
  // No distortion, mild distortion, and the barrel distortion of a wide lens (monotonic up to the
  // corner, where r2 = 2.9).
  for (const std::array<double, 4>& distortion :
       {std::array<double, 4>{}, {-0.02, 0.001, 1e-3, -5e-4}, {-0.06, 0.004, 0, 0}}) {
    const PinholeCamera lens = camera(distortion);
    for (double y = -0.5; y < 480; y += 60) {
      for (double x = -0.5; x < 752; x += 75.2) {
        const Eigen::Vector3d ray = lens.unproject({x, y});
        EXPECT_EQ(ray.z(), 1);
        EXPECT_LT((lens.project(ray * 2.5) - Eigen::Vector2d(x, y)).norm(), 1e-9)
            << distortion[0] << " at " << x << ", " << y;
      }
    }
  }
}

TEST(CameraTest, PixelsAreSquaresAboutWholeNumbers) {
  const PinholeCamera lens = camera();
  EXPECT_TRUE(lens.contains({-0.5, -0.5}));
  EXPECT_TRUE(lens.contains({751.49, 479.49}));
  EXPECT_FALSE(lens.contains({-0.51, 10}));
  EXPECT_FALSE(lens.contains({751.5, 10}));
  EXPECT_FALSE(lens.contains({10, 479.5}));
  // The middle of the image is the principal point of a centred lens: (width - 1) / 2.
  EXPECT_TRUE(lens.contains({lens.cx, lens.cy}, 239.99));
  EXPECT_FALSE(lens.contains({lens.cx, lens.cy}, 240.01));
}

TEST(CameraTest, KnowsWhetherItsLensBends) {
  EXPECT_FALSE(camera().has_distortion());
  EXPECT_TRUE(camera({0, 0, 0, 1e-6}).has_distortion());
}

}  // namespace
}  // namespace vinebench
