// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/driven_rover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "core/geometry/pose.h"
#include "sim/config_files.h"

namespace vinebench::sim {
namespace {

/// One metre along an aisle in 4 s, and a second to come to rest.
class DrivenRoverTest : public testing::Test {
 protected:
  DrivenRoverTest() {
    const std::filesystem::path models =
        std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover";
    rover_ = load_rover(models / "rover.yaml");
    world_.rows = {{{0, 1.5}, {2, 1.5}}};
    route_.speed = 0.3;
    route_.waypoints.resize(2);
    route_.waypoints[1].position = {1, 0};
    route_.waypoints[1].wait = 1;
  }
  /// The rover's final position when it is steered, 15 times a second, by `feedback`, given its
  /// true pose.
  template <class Feedback>
  Eigen::Vector3d end_of_drive(Feedback feedback) const {
    DrivenRover rover(rover_, world_, route_, 1);
    const std::int64_t frames = rover.route().duration() * 15 / kNanosecondsPerSecond;
    Stamp stamp = 0;
    for (std::int64_t i = 0; i <= frames; ++i) {
      stamp = stamp_of_frame(i, 15);
      rover.advance_to(stamp);
      feedback(rover, i, stamp);
    }
    return rover.T_world_body(stamp).translation;
  }

  RoverConfig rover_;
  WorldConfig world_;
  RouteConfig route_;
};

// A centimetre: the remaining error of the position loop with motors that differ by 1 %.
TEST_F(DrivenRoverTest, EndsAtTheRoutesEnd) {
  const Eigen::Vector3d end = end_of_drive([](DrivenRover&, std::int64_t, Stamp) {});
  EXPECT_NEAR(end.x(), 1, 0.01);
  EXPECT_NEAR(end.y(), 0, 0.01);
}

TEST_F(DrivenRoverTest, TheTruthToldGoesTheSameWay) {
  const Eigen::Vector3d end = end_of_drive([](DrivenRover& rover, std::int64_t, Stamp stamp) {
    rover.steer_by(stamp, rover.T_world_body(stamp));
  });
  EXPECT_NEAR(end.x(), 1, 0.01);
  EXPECT_NEAR(end.y(), 0, 0.01);
}

// Handing out the path at 15 Hz gives every pose once: 4 s at 200 Hz are 800, and the start's.
TEST_F(DrivenRoverTest, ThePathHasThePosesOfTheInertialInstants) {
  DrivenRover rover(rover_, world_, route_, 1);
  Trajectory path;
  for (std::int64_t i = 0; i <= 60; ++i) {
    rover.advance_to(stamp_of_frame(i, 15));
    rover.hand_out_path(stamp_of_frame(i, 15), path);
    if (path.back().stamp != stamp_of_frame(i, 15)) continue;  // every third frame
    EXPECT_EQ(path.back().pose.translation, rover.T_world_body(path.back().stamp).translation);
  }
  ASSERT_EQ(path.size(), 801u);
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(path[i].stamp, static_cast<Stamp>(i) * kNanosecondsPerSecond / 200);
  }
  EXPECT_EQ(rover.first_reading().stamp, 0);
  EXPECT_NEAR(rover.first_reading().specific_force.z(), 9.81, 0.01);  // at rest
}

// With an estimate 0.1 m too far forward and 0.05 m too far left, it stops that much short and
// right.
TEST_F(DrivenRoverTest, AWrongPoseToldIsDrivenInto) {
  const Pose shift{Eigen::Quaterniond::Identity(), {0.1, 0.05, 0}};
  const Eigen::Vector3d end = end_of_drive([&](DrivenRover& rover, std::int64_t, Stamp stamp) {
    rover.steer_by(stamp, shift * rover.T_world_body(stamp));
  });
  EXPECT_NEAR(end.x(), 0.9, 0.01);
  EXPECT_NEAR(end.y(), -0.05, 0.01);
}

// Without an estimate after the first second the last command continues: a hundredth of the
// distance for the spread of the motors, and as much for the lag of the wheels.
TEST_F(DrivenRoverTest, WithoutNewsItGoesOnAsCommanded) {
  const Eigen::Vector3d end = end_of_drive([](DrivenRover& rover, std::int64_t i, Stamp stamp) {
    if (i <= 15) rover.steer_by(stamp, rover.T_world_body(stamp));
  });
  EXPECT_NEAR(end.x(), 1, 0.02);
  EXPECT_NEAR(end.y(), 0, 0.02);
}

/// Carried 1 m to the left, 0.3 m above the ground, and turned by 90 degrees.
class CarriedRoverTest : public DrivenRoverTest {
 protected:
  CarriedRoverTest() {
    route_.waypoints[1].position = {0, 1};
    route_.waypoints[1].heading_deg = 90;
    route_.waypoints[1].lift = 0.3;
    rover_at_work_.emplace(rover_, world_, route_, 1);
  }
  Pose at(double seconds) {
    rover_at_work_->advance_to(from_seconds(seconds));
    return rover_at_work_->T_world_body(from_seconds(seconds));
  }
  double whole() const { return to_seconds(rover_at_work_->route().duration()); }

  std::optional<DrivenRover> rover_at_work_;
};

// 5 mm: what a hold of 20 rad/s has at an acceleration of 2 m/s^2 (the cosine's largest is 1.7).
TEST_F(CarriedRoverTest, IsHeldAtTheRoute) {
  const Pose half = at((whole() - 1) / 2);
  EXPECT_NEAR(half.translation.y(), 0.5, 0.005);
  EXPECT_NEAR(half.translation.z(), 0.3, 0.005);
  EXPECT_NEAR(yaw_of(half.rotation), std::numbers::pi / 4, 0.01);
}

// Released at rest, it stands where it was set down: its springs move it by millimetres.
TEST_F(CarriedRoverTest, StandsWhereItWasSetDown) {
  const Pose start = at(0);
  const Pose end = at(whole());
  EXPECT_NEAR(end.translation.x(), 0, 0.01);
  EXPECT_NEAR(end.translation.y(), 1, 0.01);
  EXPECT_NEAR(end.translation.z(), start.translation.z(), 0.001);
  EXPECT_NEAR(yaw_of(end.rotation), std::numbers::pi / 2, 0.02);
}

// Odometry is not told: driving 1 m would turn each wheel by 10 rad.
TEST_F(CarriedRoverTest, WheelsStandStill) {
  at(whole());
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  rover_at_work_->hand_out(from_seconds(whole()), imu, wheels);
  for (const WheelSample& sample : wheels) {
    for (const double angle : sample.angle) EXPECT_NEAR(angle, 0, 0.3);
  }
}

// The inertial unit is: after half of the rise, pi / 2 * 0.3 s, the rover moves upwards at 0.5 m/s,
// which is what the accelerometer's readings at 200 Hz sum up to beyond gravity. 0.02 m/s: the
// acceleration is zero there, and the hold follows within 0.1 s.
TEST_F(CarriedRoverTest, TheAccelerometerFeelsIt) {
  const double half = 0.15 * std::numbers::pi;
  at(half);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  rover_at_work_->hand_out(from_seconds(half), imu, wheels);
  double speed = 0;
  for (const ImuSample& sample : imu) speed += (sample.specific_force.z() - 9.81) / 200;
  EXPECT_NEAR(speed, 0.5, 0.02);
}

/// Drives by commands for so many frames of 15 Hz, from frame `from` on.
void drive_frames(DrivenRover& rover, std::int64_t from, std::int64_t frames) {
  for (std::int64_t i = 1; i <= frames; ++i) rover.advance_to(stamp_of_frame(from + i, 15));
}

// 0.2 m/s forward and 0.1 m/s left for 2 s are (0.4, 0.2) m; the route would go to (0.6, 0). 3 cm:
// motors differ by 1 %, so that it turns by some tenths of a degree a second, and it starts with
// the torque that its motors have.
TEST_F(DrivenRoverTest, ACommandIsDrivenInPlaceOfTheRouteUntilTheNext) {
  DrivenRover rover(rover_, world_, route_, 1);
  rover.command({0.2, 0.1, 0});
  drive_frames(rover, 0, 30);
  const Eigen::Vector3d driven = rover.T_world_body(stamp_of_frame(30, 15)).translation;
  EXPECT_NEAR(driven.x(), 0.4, 0.03);
  EXPECT_NEAR(driven.y(), 0.2, 0.03);
  rover.command(Eigen::Vector3d::Zero());
  drive_frames(rover, 30, 15);
  const Eigen::Vector3d stopped = rover.T_world_body(stamp_of_frame(45, 15)).translation;
  EXPECT_LT((stopped - driven).norm(), 0.03);  // it comes to rest: 0.22 m/s would be 0.22 m
  drive_frames(rover, 45, 15);
  const Eigen::Vector3d still = rover.T_world_body(stamp_of_frame(60, 15)).translation;
  EXPECT_LT((still - stopped).norm(), 0.001);
}

// 1 rad/s to the left for a second, in place. 0.1 rad and 2 cm: slip of the rollers as it starts.
TEST_F(DrivenRoverTest, ACommandTurnsToTheLeft) {
  DrivenRover rover(rover_, world_, route_, 1);
  rover.command({0, 0, 1});
  drive_frames(rover, 0, 15);
  const Pose pose = rover.T_world_body(stamp_of_frame(15, 15));
  EXPECT_NEAR(yaw_of(pose.rotation), 1, 0.1);
  EXPECT_LT(pose.translation.head<2>().norm(), 0.02);
}

// Sideways into the row's first post, 1.5 m to the left. The rover reaches 0.2 to 0.4 m aside, so
// that at 0.5 m/s they meet after 2.2 to 2.6 s.
TEST_F(DrivenRoverTest, ACollisionIsNoticedSinceTheLatestCommand) {
  DrivenRover rover(rover_, world_, route_, 1);
  rover.command({0, 0.5, 0});
  drive_frames(rover, 0, 27);
  EXPECT_FALSE(rover.collided());
  drive_frames(rover, 27, 18);
  EXPECT_TRUE(rover.collided());
  rover.command({0, -0.5, 0});
  EXPECT_FALSE(rover.collided());
  drive_frames(rover, 45, 15);
  rover.command({0, -0.5, 0});
  drive_frames(rover, 60, 5);
  EXPECT_FALSE(rover.collided());
}

}  // namespace
}  // namespace vinebench::sim
