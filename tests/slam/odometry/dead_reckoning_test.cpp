// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/odometry/dead_reckoning.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

TEST(DeadReckoningTest, KeepsTheVelocityAndDoubtsItMoreAndMore) {
  DeadReckoning reckoning{DeadReckoningConfig{}};
  EXPECT_FALSE(reckoning.active());
  Vector6d velocity = Vector6d::Zero();
  velocity[0] = 0.4;  // m/s
  Pose moved;
  for (int i = 0; i < 10; ++i) moved = moved * reckoning.advance(std::nullopt, velocity, 0.1);
  EXPECT_NEAR(moved.translation.x(), 0.4, 1e-12);
  // Half of 0.5 m/s^2 times a second squared, and likewise in rad.
  EXPECT_NEAR(reckoning.sigma_position(), 0.25, 1e-12);
  EXPECT_NEAR(reckoning.sigma_rotation(), 0.25, 1e-12);
  EXPECT_FALSE(reckoning.is_lost());
  for (int i = 0; i < 11; ++i) reckoning.advance(std::nullopt, velocity, 0.1);
  EXPECT_TRUE(reckoning.is_lost());  // 0.25 * 2.1^2 = 1.1 m
  reckoning.reset();
  EXPECT_FALSE(reckoning.active());
  EXPECT_EQ(reckoning.sigma_position(), 0);
}

TEST(DeadReckoningTest, DoubtsWheelsByTheWayTheyWent) {
  DeadReckoning reckoning{DeadReckoningConfig{}};
  const WheelStep step{{Eigen::Quaterniond::Identity(), {0.1, 0, 0}}, 0.1};
  for (int i = 0; i < 20; ++i) reckoning.advance(step, Vector6d::Zero(), 0.1);
  // 2 m: 5 % is 0.1 m of slip; 0.05 rad a metre is 0.1 rad, half of it over 2 m is 0.1 m sideways.
  EXPECT_NEAR(reckoning.sigma_position(), std::hypot(0.1, 0.1), 1e-9);
  EXPECT_NEAR(reckoning.sigma_rotation(), 0.1, 1e-9);
  // The same time with a constant velocity would give 1 m.
  EXPECT_FALSE(reckoning.is_lost());
}

// Local adjustments turn the newest keyframe a little nearer to gravity, again and again: if
// gravity were turned along, the map would turn for good.
TEST(DeadReckoningTest, ACorrectedPoseLeavesGravityInTheMap) {
  DeadReckoning reckoning{DeadReckoningConfig{}, InertialNoise{}};
  ImuSample stands;
  stands.stamp = 1'000'000'000;
  stands.specific_force = {0, 0, 9.8};
  reckoning.arrive({stands}, std::nullopt, stands.stamp);
  reckoning.see(Pose{}, 1e-6 * Matrix6d::Identity());
  ASSERT_TRUE(reckoning.gravity());
  const Eigen::Vector3d gravity = reckoning.gravity()->gravity;
  const Pose T_new_old{exp_so3({0.01, 0, 0}), {0.1, 0, 0}};
  reckoning.correct(T_new_old);
  EXPECT_EQ(reckoning.gravity()->gravity, gravity);
  EXPECT_LT(reckoning.T_map_body()->rotation.angularDistance(T_new_old.rotation), 1e-7);
  reckoning.believe_gravity({0, 1, -9.7});
  EXPECT_EQ(reckoning.gravity()->gravity, Eigen::Vector3d(0, 1, -9.7));
}

}  // namespace
}  // namespace vinebench::slam
