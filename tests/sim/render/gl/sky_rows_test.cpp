// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/sky_rows.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vinebench::sim {
namespace {

/// A camera that looks along x, pitched up by an angle in degrees; 90 degrees of view each way.
Eigen::Matrix4f ray_from_clip(double pitch_deg) {
  const double pitch = pitch_deg * 0.017453292519943295;
  const auto s = static_cast<float>(std::sin(pitch)), c = static_cast<float>(std::cos(pitch));
  Eigen::Matrix4f m = Eigen::Matrix4f::Zero();
  m.col(0).head<3>() = Eigen::Vector3f(0, -1, 0);
  m.col(1).head<3>() = Eigen::Vector3f(s, 0, -c);  // the clip space's y points down in the image
  m.col(2).head<3>() = Eigen::Vector3f(c, 0, s);
  return m;
}

// The ray (1, -x, -y) is 0.07 or more below the horizon where y > 0.07 sqrt(1 + x^2 + y^2): at the
// rim, x = 1, from y = 0.0993 on. Bands are 1/16 high; the one from 0.0625 to 0.125 still counts.
TEST(SkyRowsTest, EndBelowTheHorizon) {
  const auto rows = rows_with_sky(ray_from_clip(0));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].x(), -1);
  EXPECT_EQ(rows[0].y(), 0.125f);
}

TEST(SkyRowsTest, AreAllOfAViewUpwardsAndNoneOfOneDownwards) {
  const auto up = rows_with_sky(ray_from_clip(60));
  ASSERT_EQ(up.size(), 1u);
  EXPECT_EQ(up[0], Eigen::Vector2f(-1, 1));
  EXPECT_TRUE(rows_with_sky(ray_from_clip(-80)).empty());
}

TEST(SkyRowsTest, BelowTheHorizonIsTheColourOfTheImagesCorner) {
  cv::Mat sky(4, 4, CV_8UC4, cv::Scalar(0, 0, 0, 255));
  sky.at<cv::Vec4b>(0, 0) = {51, 102, 255, 255};
  EXPECT_TRUE(below_horizon(sky).isApprox(Eigen::Vector4f(0.2f, 0.4f, 1, 0), 1e-6f));
}

}  // namespace
}  // namespace vinebench::sim
