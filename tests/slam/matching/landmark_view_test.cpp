// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/landmark_view.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vinebench::slam {
namespace {

/// At the map's origin, looking along z.
std::optional<LandmarkView> view(const Eigen::Vector3d& position, const Eigen::Vector3d& normal) {
  const PinholeCamera lens{640, 480, 400, 400, 319.5, 239.5, {}};
  Landmark landmark;
  landmark.position = position;
  landmark.normal = normal;
  return view_landmark(landmark, Pose{}, lens);
}

const Eigen::Vector3d kAhead = Eigen::Vector3d::UnitZ();

TEST(LandmarkViewTest, TellsPixelAndDepth) {
  const auto seen = view({0.5, -0.25, 2}, kAhead);
  ASSERT_TRUE(seen);
  // 319.5 + 400 * 0.5 / 2, 239.5 - 400 * 0.25 / 2.
  EXPECT_NEAR(seen->pixel.x(), 419.5, 1e-9);
  EXPECT_NEAR(seen->pixel.y(), 189.5, 1e-9);
  EXPECT_EQ(seen->depth, 2);
}

TEST(LandmarkViewTest, NoneBehindTheCameraOrOutsideOfTheImage) {
  EXPECT_FALSE(view({0, 0, -2}, kAhead));
  // Half the image is 319.5 px: 1.5975 m at 2 m; six pixels less are 1.5675 m.
  EXPECT_FALSE(view({1.58, 0, 2}, kAhead));
  EXPECT_TRUE(view({1.56, 0, 2}, kAhead));
}

TEST(LandmarkViewTest, NoneFromMoreThanSixtyDegreesAround) {
  const auto turned = [](double degrees) {
    const double angle = degrees * std::acos(-1.0) / 180;
    return Eigen::Vector3d(std::sin(angle), 0, std::cos(angle));
  };
  EXPECT_TRUE(view({0, 0, 2}, turned(59)));
  EXPECT_FALSE(view({0, 0, 2}, turned(61)));
}

}  // namespace
}  // namespace vinebench::slam
