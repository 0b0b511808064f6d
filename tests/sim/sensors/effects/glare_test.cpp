// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/glare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

class GlareTest : public testing::Test {
 protected:
  static constexpr int kGrey = 80;
  PinholeCamera camera_ = test::small_camera();
  cv::Mat rgb_{camera_.height, camera_.width, CV_8UC3, cv::Scalar::all(kGrey)};
  cv::Mat labels_{camera_.height, camera_.width, CV_8UC1,
                  cv::Scalar(static_cast<int>(Label::kSky))};
  Light light_;
  Eigen::Vector3d ahead_ = Eigen::Vector3d::UnitZ();

  int green(double x, double y) const {
    return rgb_.at<cv::Vec3b>(static_cast<int>(y), static_cast<int>(x))[1];
  }
};

TEST_F(GlareTest, SaturatesAtTheSunAndFallsOffWithTheAngle) {
  add_glare(rgb_, labels_, camera_, ahead_, light_, 1);
  EXPECT_EQ(green(camera_.cx, camera_.cy), 255);
  const int near = green(camera_.cx + 30, camera_.cy);  // 6.5 degrees off
  const int far = green(camera_.cx + 200, camera_.cy);  // 37 degrees off
  EXPECT_GT(near, far);
  // The veil: (80 / 255)^2.2 = 0.078 of light, 0.02 and 0.22 / (1 + (37 / 5)^2) = 0.004 more of it,
  // encoded 255 * 0.102^(1 / 2.2) = 90.
  EXPECT_NEAR(far, 90, 1);
}

TEST_F(GlareTest, AnyAngleIsAsDefined) {
  for (const Eigen::Vector3d& sun :
       {ahead_, Eigen::Vector3d(0.9, 0.3, 1), Eigen::Vector3d(-0.2, -0.5, 1)}) {
    for (const double exposure : {0.3, 1.0, 5.0}) {
      rgb_.setTo(cv::Scalar::all(kGrey));
      add_glare(rgb_, labels_, camera_, sun, light_, exposure);
      ASSERT_NE(green(0, 0), kGrey) << "the sun is in the image";
      for (int y = 0; y < rgb_.rows; ++y) {
        for (int x = 0; x < rgb_.cols; ++x) {
          const Eigen::Vector3d ray((x - camera_.cx) / camera_.fx, (y - camera_.cy) / camera_.fy,
                                    1);
          const double angle =
              std::atan2(ray.cross(sun).norm(), ray.dot(sun)) * 180 / std::numbers::pi;
          const double spread =
              6 * std::exp(-std::pow(angle / 0.8, 2)) + 0.22 / (1 + std::pow(angle / 5, 2)) + 0.02;
          const double light =
              std::min(1.0, std::pow(kGrey / 255.0, 2.2) +
                                exposure * spread * static_cast<double>(light_.sun.y()));
          // Rounded once by the table of its square root, a 16th of a grey level, and once to a
          // byte.
          ASSERT_NEAR(green(x, y), 255 * std::pow(light, 1 / 2.2), 0.57) << angle << " degrees";
        }
      }
    }
  }
}

TEST_F(GlareTest, ACoveredSunOrOneOutOfTheImageChangesNothing) {
  const cv::Mat clean = rgb_.clone();
  labels_.setTo(static_cast<int>(Label::kLeaf));
  add_glare(rgb_, labels_, camera_, ahead_, light_, 1);
  EXPECT_EQ(cv::norm(clean, rgb_, cv::NORM_INF), 0);
  labels_.setTo(static_cast<int>(Label::kSky));
  add_glare(rgb_, labels_, camera_, -ahead_, light_, 1);
  add_glare(rgb_, labels_, camera_, Eigen::Vector3d(0, -1, 0.3), light_, 1);  // above the image
  light_.glare = 0;
  add_glare(rgb_, labels_, camera_, ahead_, light_, 1);
  EXPECT_EQ(cv::norm(clean, rgb_, cv::NORM_INF), 0);
}

TEST_F(GlareTest, AHalfCoveredSunGlaresByHalf) {
  labels_(cv::Rect(0, 0, labels_.cols, labels_.rows / 2)) = static_cast<int>(Label::kLeaf);
  add_glare(rgb_, labels_, camera_, ahead_, light_, 1);
  // 0.078 + 0.024 / 2 of light and a little more: the disc's middle row counts as open.
  EXPECT_NEAR(green(camera_.cx + 200, camera_.cy), 85, 2);
}

}  // namespace
}  // namespace vinebench::sim
