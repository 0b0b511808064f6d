// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/gravity_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/support/swinging_body.h"

namespace vinebench::slam {
namespace {

using test::SwingingBody;

constexpr double kInterval = 0.3;  // s

/// Keyframes of a swinging body whose accelerometer has such a bias.
Map swinging_map(const SwingingBody& body, int keyframes, const Eigen::Vector3d& bias) {
  Map map{1.2};
  for (int k = 0; k < keyframes; ++k) {
    map.add_keyframe(std::make_shared<FrameFeatures>(), SwingingBody::pose(k * kInterval), {});
    if (k > 0) map.keyframe(k).motion = body.motion((k - 1) * kInterval, k * kInterval, bias);
  }
  return map;
}

// The belief in no bias of b0 (0.05 m/s^2) pulls the estimate by its covariance times bias / b0^2,
// and nothing else does: the integration in the test is exact to 3e-5 m/s^2.
TEST(GravityFitTest, FindsGravityAndBias) {
  const SwingingBody body;
  const Eigen::Vector3d bias(0.02, -0.01, 0.03);
  const InertialNoise inertial;
  const auto found = fit_gravity(swinging_map(body, 40, bias), inertial);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->by_world);
  Vector6d error;
  error << found->gravity - body.gravity, found->accelerometer_bias - bias;
  const Vector6d pull =
      -found->covariance.rightCols<3>() * bias / std::pow(inertial.accelerometer.bias, 2);
  EXPECT_LT((error - pull).norm(), 2e-4);
  EXPECT_LT(error.norm(), 5e-3);  // of a bias of 0.037
}

// It feels the sum of gravity and bias alone: neither is known better than the bias was beforehand.
// Their difference is, by ten readings of 0.6 s, each (2 * 5e-3 m/s^2/sqrt(Hz)) / sqrt(3 * 0.6 s).
TEST(GravityFitTest, ABodyThatStandsDoesNotTellThemApart) {
  const Eigen::Vector3d gravity(0, 0, -9.8);
  Map map{1.2};
  for (int k = 0; k < 12; ++k) {
    map.add_keyframe(std::make_shared<FrameFeatures>(), Pose{}, {});
    PreintegratedMotion stands;
    stands.add(Eigen::Vector3d::Zero(), -gravity, Eigen::Vector3d::Zero(), kInterval);
    if (k > 0) map.keyframe(k).motion = stands;
  }
  const InertialNoise inertial;
  const auto found = fit_gravity(map, inertial);
  ASSERT_TRUE(found);
  EXPECT_LT((found->gravity - gravity).norm(), 1e-9);
  const double apart = std::sqrt(found->covariance(0, 0));
  EXPECT_NEAR(apart, inertial.accelerometer.bias, 0.01 * inertial.accelerometer.bias);
  Vector6d together;  // gravity less bias, x
  together << 1, 0, 0, -1, 0, 0;
  const double sigma = std::sqrt(together.dot(found->covariance * together));
  // The gyroscope's part is added: 9.8 * 4e-4 * sqrt(0.6 / 3) = 1.8e-3 m/s^2.
  EXPECT_NEAR(sigma, std::hypot(7.45e-3, 1.75e-3) / std::sqrt(10), 2e-5);
}

TEST(GravityFitTest, WithoutReadingsThereIsNone) {
  const SwingingBody body;
  EXPECT_FALSE(fit_gravity(Map{1.2}, InertialNoise{}));
  Map map = swinging_map(body, 3, Eigen::Vector3d::Zero());
  EXPECT_TRUE(fit_gravity(map, InertialNoise{}));
  map.keyframe(1).motion->seconds = 2.1;
  EXPECT_FALSE(fit_gravity(map, InertialNoise{}));
  map.keyframe(1).motion.reset();
  EXPECT_FALSE(fit_gravity(map, InertialNoise{}));
}

}  // namespace
}  // namespace vinebench::slam
