// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/pose.h"

#include <gtest/gtest.h>

#include <numbers>

namespace vinebench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-14;  // a few roundings of numbers about 1

Pose pose_a() {
  return {exp_so3({0.3, -0.8, 1.1}), {1.0, -2.0, 0.5}};
}
Pose pose_b() {
  return {exp_so3({-1.2, 0.1, 0.4}), {-0.3, 0.7, 2.0}};
}

TEST(PoseTest, TakesAPointFromItsSecondFrameToItsFirst) {
  // b is at (1, 2, 3) in a, its x axis along a's y axis.
  const Pose T_a_b{exp_so3({0, 0, kPi / 2}), {1, 2, 3}};
  const Eigen::Vector3d p_a = T_a_b * Eigen::Vector3d(5, 0, 0);
  EXPECT_LT((p_a - Eigen::Vector3d(1, 7, 3)).norm(), kRounding);
}

TEST(PoseTest, CompositionIsThatOfMatrices) {
  const Eigen::Matrix4d product = pose_a().matrix() * pose_b().matrix();
  EXPECT_LT(((pose_a() * pose_b()).matrix() - product).norm(), kRounding);
  const Eigen::Vector3d p(0.1, 0.2, 0.3);
  EXPECT_LT(((pose_a() * pose_b()) * p - pose_a() * (pose_b() * p)).norm(), kRounding);
}

TEST(PoseTest, InverseUndoes) {
  EXPECT_LT(((pose_a() * pose_a().inverse()).matrix() - Eigen::Matrix4d::Identity()).norm(),
            kRounding);
  EXPECT_LT(((pose_a().inverse() * pose_a()).matrix() - Eigen::Matrix4d::Identity()).norm(),
            kRounding);
}

TEST(PoseTest, StaysRigidOverALongChain) {
  Pose chain;
  for (int i = 0; i < 100000; ++i)
    chain = chain * Pose{exp_so3({0.01, 0.02, -0.03}), Eigen::Vector3d::Zero()};
  EXPECT_NEAR(chain.rotation.norm(), 1, kRounding);
}

TEST(PoseTest, RotationVectorComesBackFromNoneToNearlyHalfATurn) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
  for (const double angle : {0.0, 1e-300, 1e-12, 1e-9, 0.99e-6, 1.01e-6, 1e-3, 1.0, kPi / 2, 3.0,
                             kPi - 1e-6, kPi - 1e-12}) {
    const Eigen::Vector3d back = log_so3(exp_so3(angle * axis));
    EXPECT_LE((back - angle * axis).norm(), 4e-16 + 4e-15 * angle) << angle;
  }
}

TEST(PoseTest, HalfATurnIsEitherOfItsVectors) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.2, 0.4, -0.6).normalized();
  const Eigen::Vector3d back = log_so3(exp_so3(kPi * axis));
  EXPECT_NEAR(back.norm(), kPi, kRounding);
  EXPECT_NEAR(std::abs(back.dot(axis)), kPi, kRounding);
}

TEST(PoseTest, BeyondHalfATurnTheShorterWayIsGiven) {
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
  EXPECT_LT((log_so3(exp_so3(1.5 * kPi * axis)) + 0.5 * kPi * axis).norm(), kRounding);
  EXPECT_NEAR(angle_of(exp_so3(1.5 * kPi * axis)), 0.5 * kPi, kRounding);
  Eigen::Quaterniond q = exp_so3({0.1, 0.2, 0.3});
  q.coeffs() *= -1;  // the same rotation
  EXPECT_LT((log_so3(q) - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), kRounding);
}

TEST(PoseTest, InterpolatesAlongTheShortestTurn) {
  const Pose a{exp_so3({0, 0, 0.2}), {0, 0, 0}};
  Pose b{exp_so3({0, 0, 1.0}), {4, -2, 1}};
  const Pose quarter = interpolate(a, b, 0.25);
  EXPECT_LT((log_so3(quarter.rotation) - Eigen::Vector3d(0, 0, 0.4)).norm(), kRounding);
  EXPECT_LT((quarter.translation - Eigen::Vector3d(1, -0.5, 0.25)).norm(), kRounding);
  b.rotation.coeffs() *= -1;
  EXPECT_LT(angle_of(quarter.rotation.conjugate() * interpolate(a, b, 0.25).rotation), 1e-7);
  EXPECT_LT((interpolate(a, b, 0).matrix() - a.matrix()).norm(), kRounding);
  EXPECT_LT((interpolate(a, b, 1).matrix() - b.matrix()).norm(), kRounding);
}

TEST(PoseTest, RollPitchYawTurnAboutTheFixedAxesInThatOrder) {
  // Roll takes z to -y, yaw takes -y to x.
  const Eigen::Quaterniond q = from_roll_pitch_yaw({kPi / 2, 0, kPi / 2});
  EXPECT_LT((q * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), kRounding);
  // Pitch about +y takes x to -z: a positive pitch looks down.
  EXPECT_LT(
      (from_roll_pitch_yaw({0, kPi / 2, 0}) * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitZ())
          .norm(),
      kRounding);
}

TEST(PoseTest, ARotationIsOrthonormalAndDoesNotMirror) {
  const Eigen::Matrix3d R = exp_so3({0.1, -0.2, 0.3}).toRotationMatrix();
  EXPECT_TRUE(is_rotation(R, 1e-9));
  EXPECT_FALSE(is_rotation(-R, 1e-9));        // determinant -1
  EXPECT_TRUE(is_rotation(1.001 * R, 0.01));  // R R^T has 1.002 on its diagonal
  EXPECT_FALSE(is_rotation(1.01 * R, 0.01));  // 1.0201
  Eigen::Matrix3d unknown = R;
  unknown(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_rotation(unknown, 0.01));
}

TEST(PoseTest, YawIsTheHeadingWhateverRollAndPitch) {
  EXPECT_NEAR(yaw_of(from_roll_pitch_yaw({0.4, -0.3, 2.5})), 2.5, kRounding);
  EXPECT_NEAR(yaw_of(from_roll_pitch_yaw({0, 0.2, -3.1})), -3.1, kRounding);
}

}  // namespace
}  // namespace vinebench
