// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/camera.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vinebench {
namespace {

PinholeCamera camera(const std::vector<double>& distortion = {0, 0, 0, 0}) {
  PinholeCamera camera{752, 480, 263.2786, 260.0, 375.5, 239.5};
  camera.set_lens(LensModel::kRadialTangential, distortion);
  return camera;
}

/// As the cameras of TUM-VI: 512 x 512 px, more than 180 degrees from corner to corner.
PinholeCamera fisheye() {
  PinholeCamera camera{512, 512, 190.98, 190.97, 254.93, 256.90};
  camera.set_lens(LensModel::kEquidistant, {0.0034823894, 0.0007150348, -0.0020532361, 0.0002029});
  return camera;
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

TEST(CameraTest, TheThirdRadialCoefficientIsTheFifth) {
  // x = 0.4, y = 0.2: r2 = 0.2, radial = 1 + 0.2 * 0.2 * 0.2 * 0.5 = 1.004.
  const Eigen::Vector2d pixel = camera({0, 0, 0, 0, 0.5}).project({0.8, 0.4, 2});
  EXPECT_NEAR(pixel.x(), 375.5 + 263.2786 * 0.4 * 1.004, 1e-10);
  EXPECT_NEAR(pixel.y(), 239.5 + 260.0 * 0.2 * 1.004, 1e-10);
}

TEST(CameraTest, AnEquidistantLensIsKannalaAndBrandts) {
  PinholeCamera lens = camera();
  lens.set_lens(LensModel::kEquidistant, {0.1, -0.02, 0.003, -0.0004});
  // 45 degrees to the right: theta = pi / 4 = 0.785398, theta^2 = 0.616850;
  // 1 + 0.061685 - 0.02 * 0.380504 + 0.003 * 0.234714 - 0.0004 * 0.144783 = 1.0547212.
  const Eigen::Vector2d pixel = lens.project({3, 0, 3});
  EXPECT_NEAR(pixel.x(), 375.5 + 263.2786 * 0.785398163 * 1.0547212, 1e-4);
  EXPECT_DOUBLE_EQ(pixel.y(), 239.5);
}

TEST(CameraTest, ADoubleSphereLensIsUsenkosAndOthers) {
  PinholeCamera lens = camera();
  lens.set_lens(LensModel::kDoubleSphere, {-0.2, 0.6});
  // The point (3, 0, 4): d1 = 5, xi d1 + z = 3, d2 = sqrt(9 + 9) = 4.242641;
  // x / (0.6 * 4.242641 + 0.4 * 3) = 3 / 3.745584 = 0.800943.
  const Eigen::Vector2d pixel = lens.project({3, 0, 4});
  EXPECT_NEAR(pixel.x(), 375.5 + 263.2786 * 0.800943, 1e-4);
  EXPECT_DOUBLE_EQ(pixel.y(), 239.5);
  // Near the axis it magnifies by 1 / (1 + xi) = 1.25.
  EXPECT_DOUBLE_EQ(lens.without_distortion().fx, 1.25 * 263.2786);
  EXPECT_NEAR(lens.project({1e-6, 0, 1}).x() - 375.5, 1.25 * 263.2786e-6, 1e-10);
}

TEST(CameraTest, UnprojectUndoesProjectOfFisheyes) {
  PinholeCamera spheres = fisheye();
  spheres.fx = spheres.fy = 158;
  spheres.set_lens(LensModel::kDoubleSphere, {-0.18, 0.59});
  for (const PinholeCamera& lens : {fisheye(), spheres}) {
    for (double y = 0; y < 512; y += 32) {
      for (double x = 0; x < 512; x += 32) {
        const Eigen::Vector3d ray = lens.unproject({x, y});
        EXPECT_EQ(ray.z(), 1);
        const double r = ray.head<2>().norm();
        if (r > 0.999 * PinholeCamera::kWidest) continue;  // as far aside as it may lie, or farther
        // Of an angle near 90 degrees the tangent loses digits: 1e-16 r^2 of an angle.
        const double tolerance = 1e-9 + 1e-12 * r * r;
        EXPECT_LT((lens.project(ray * 2.5) - Eigen::Vector2d(x, y)).norm(), tolerance)
            << x << ", " << y;
      }
    }
  }
}

TEST(CameraTest, WhatAFisheyeSeesBehindItIsFarAside) {
  // The corner of TUM-VI's image is seen at some 1.9 rad.
  const Eigen::Vector3d ray = fisheye().unproject({0, 0});
  EXPECT_NEAR(ray.head<2>().norm(), PinholeCamera::kWidest, 1e-6 * PinholeCamera::kWidest);
  EXPECT_LT(ray.x(), 0);
  EXPECT_LT(ray.y(), 0);
}

TEST(CameraTest, CoefficientsAreAsManyAsTheLensHas) {
  EXPECT_EQ(camera({1, 2, 3, 4}).coefficients(), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(camera({1, 2, 3, 4, 5}).coefficients(), (std::vector<double>{1, 2, 3, 4, 5}));
  EXPECT_EQ(camera({1, 2, 3, 4, 0}).coefficients(), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(fisheye().coefficients().size(), 4u);
  PinholeCamera spheres = camera();
  spheres.set_lens(LensModel::kDoubleSphere, {0, 0.5});
  EXPECT_EQ(spheres.coefficients(), (std::vector<double>{0, 0.5}));
  EXPECT_TRUE(spheres.has_distortion());
  for (const auto& [model, counts] :
       {std::pair(LensModel::kRadialTangential, std::vector<std::size_t>{4, 5}),
        std::pair(LensModel::kEquidistant, std::vector<std::size_t>{4}),
        std::pair(LensModel::kDoubleSphere, std::vector<std::size_t>{2})}) {
    for (std::size_t count = 0; count < 10; ++count) {
      EXPECT_EQ(has_coefficients(model, count), std::ranges::count(counts, count) > 0) << count;
    }
  }
}

TEST(CameraTest, UnprojectUndoesProjectAllOverTheImage) {
  // No distortion, mild distortion, and the barrel distortion of a wide lens (monotonic up to the
  // corner, where r2 = 2.9).
  for (const std::vector<double>& distortion : {std::vector<double>{0, 0, 0, 0},
                                                {-0.02, 0.001, 1e-3, -5e-4},
                                                {-0.06, 0.004, 0, 0},
                                                {-0.06, 0.004, 0, 0, 1e-4}}) {
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
