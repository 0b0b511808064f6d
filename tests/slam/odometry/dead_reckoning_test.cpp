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

// Gates allow for what was told; how sure a pose is goes by how wrong the wheels were.
TEST(DeadReckoningTest, LearnsHowGoodTheWheelsAre) {
  DeadReckoning reckoning{DeadReckoningConfig{}};
  const WheelStep step{{Eigen::Quaterniond::Identity(), {0.1, 0, 0}}, 0.1};
  Pose T_map_body;
  const auto go = [&](double share) {
    reckoning.arrive({}, step, 0);
    T_map_body = T_map_body * Pose{Eigen::Quaterniond::Identity(), {0.1 * share, 0, 0}};
    reckoning.see(T_map_body, Matrix6d::Identity());
    reckoning.reset();
  };
  for (int i = 0; i < 20; ++i) reckoning.advance(step, Vector6d::Zero(), 0.1);
  const Matrix6d told = reckoning.covariance();
  EXPECT_NEAR(std::sqrt(told(0, 0)), 0.1, 1e-4);  // 5 % of 2 m
  for (int i = 0; i < 200; ++i) go(0.99);
  for (int i = 0; i < 20; ++i) reckoning.advance(step, Vector6d::Zero(), 0.1);
  const Matrix6d learnt = reckoning.covariance();
  EXPECT_NEAR(std::sqrt(learnt(0, 0)), 0.02, 0.002);  // 1 % of 2 m, and a little that was told
  // What was told leaves 1.1 mm and 1.1 mrad a metre in each stretch of 0.3 m: seven of 0.34 mm,
  // seven of 0.34 mrad by what is left of the way, 0.9 mm each, and the floor of 1 mm.
  EXPECT_NEAR(std::sqrt(learnt(1, 1)), 0.0017, 0.0002);
  EXPECT_NEAR(std::sqrt(reckoning.worst_covariance()(0, 0)), std::hypot(0.1, 0.1), 1e-4);
  EXPECT_NEAR(reckoning.sigma_position(), std::hypot(0.1, 0.1), 1e-9);
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
