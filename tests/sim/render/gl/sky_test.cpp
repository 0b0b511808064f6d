// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace vinebench::sim {
namespace {

class SkyTest : public testing::Test {
 protected:
  SkyTest() {
    light_.sun.setZero();
    light_.sky = {0.3f, 0.35f, 0.4f};
  }
  /// The sky's colour in a direction, by the header's formula.
  cv::Vec4b at(const Eigen::Vector3d& direction, std::uint64_t seed = 1) const {
    const cv::Mat image = sky_image(light_, seed);
    const Eigen::Vector3d ray = direction.normalized();
    const Eigen::Vector2d uv =
        Eigen::Vector2d::Constant(0.5) + 0.5 / 1.4 * ray.head<2>() / (1 + ray.z());
    return image.at<cv::Vec4b>(static_cast<int>(uv.y() * image.rows),
                               static_cast<int>(uv.x() * image.cols));
  }
  /// The byte of a light.
  static double byte_of(double light) { return 255 / kSkyBrightest * std::pow(light, 1 / 2.2); }
  Light light_;
};

TEST_F(SkyTest, IsASquareOpaqueImage) {
  const cv::Mat image = sky_image(light_, 1);
  EXPECT_EQ(image.type(), CV_8UC4);
  EXPECT_EQ(image.rows, image.cols);
  cv::Mat alpha;
  cv::extractChannel(image, alpha, 3);
  EXPECT_EQ(cv::countNonZero(alpha != 255), 0);
}

TEST_F(SkyTest, BelowTheHorizonIsLand) {
  light_.bounce = {0.2f, 0.1f, 0.05f};
  const cv::Vec4b land = at({1, 1, -0.7});
  // The land's colour is 0.8, 0.95 and 0.8 of the light that it throws back.
  EXPECT_NEAR(land[0], byte_of(0.8 * 0.2), 1);
  EXPECT_NEAR(land[1], byte_of(0.95 * 0.1), 1);
  EXPECT_NEAR(land[2], byte_of(0.8 * 0.05), 1);
}

TEST_F(SkyTest, AClearSkyIsBluerUpAndBrighterAtTheHorizon) {
  const cv::Vec4b zenith = at({0, 0, 1}), low = at({0, 1, 0.05});
  EXPECT_GT(zenith[2] - zenith[0], low[2] - low[0]);
  EXPECT_GT(low[0], zenith[0]);
}

TEST_F(SkyTest, GlowsAroundTheSun) {
  light_.sun.setConstant(0.5f);
  light_.towards_sun = Eigen::Vector3f(1, 0, 1).normalized();
  // 0.85 of the sun's light more, whatever cloud may be before it brightens further.
  EXPECT_GT(at({1, 0, 1})[0], at({-1, 0, 1})[0] + 40);
  EXPECT_GT(at({1, 0.2, 1})[0], at({1, 1.5, 1})[0]);
}

/// Moon and Spencer: the zenith of an overcast sky is three times as bright as its horizon.
TEST_F(SkyTest, AnOvercastSkyIsGreyAndBrightestUp) {
  light_.overcast = 1;
  const auto linear = [](int byte) { return std::pow(byte * kSkyBrightest / 255, 2.2); };
  const cv::Vec4b zenith = at({0, 0, 1}), low = at({0, 1, 0.05});
  // 3 to 1.1, with rolls of cloud of up to 16 % to either side.
  EXPECT_NEAR(linear(zenith[1]) / linear(low[1]), 3 / 1.1, 0.3 * 3 / 1.1);
  // As blue as the light that it is given.
  EXPECT_NEAR(linear(zenith[2]) / linear(zenith[0]), 0.4 / 0.3, 0.05);
}

TEST_F(SkyTest, HazeHidesTheHorizonFirst) {
  light_.bounce.setZero();
  const cv::Vec4b clear_zenith = at({0, 0, 1});
  light_.haze = 2e-4f;
  // At the horizon 1000 m / 0.03 of air: all of it; straight up 18 %.
  EXPECT_NEAR(at({0, 1, 0.03})[0], byte_of(0.5 * 1.55 * 0.3), 2);
  EXPECT_NEAR(at({0, 1, -0.3})[0], byte_of(0.5 * 1.55 * 0.3), 2);  // and the land
  EXPECT_NEAR(at({0, 0, 1})[0], clear_zenith[0], 25);
}

TEST_F(SkyTest, CloudsAreDrawnBySeed) {
  light_.sun.setOnes();
  const cv::Mat first = sky_image(light_, 1);
  EXPECT_EQ(cv::norm(first, sky_image(light_, 1), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(first, sky_image(light_, 2), cv::NORM_INF), 20);
}

}  // namespace
}  // namespace vinebench::sim
