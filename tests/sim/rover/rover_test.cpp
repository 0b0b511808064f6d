// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/rover.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/files/files.h"
#include "core/geometry/rig.h"
#include "core/util/error.h"
#include "sim/config_files.h"
#include "sim/rover/route.h"
#include "sim/rover/wheel_controller.h"
#include "tests/support/csl_rover.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(RoverTest, StandsStillOnTheGroundAtTheStart) {
  Rover rover(test::csl_rover(), test::field(), {1, -2, 2.5}, 4);
  const Pose start = rover.T_world_body();
  EXPECT_EQ(rover.now(), 0);
  EXPECT_NEAR(start.translation.x(), 1, 1e-12);
  EXPECT_NEAR(start.translation.y(), -2, 1e-12);
  EXPECT_NEAR(yaw_of(start.rotation), 2.5, 1e-12);
  // Each wheel is between two rollers' crests: 0.5 mm covers the wheels' ripple.
  EXPECT_NEAR(start.translation.z(), 0, 0.0005);
  EXPECT_LT((start.rotation * Eigen::Vector3d::UnitZ()).head<2>().norm(), 0.002);

  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  rover.advance_to(kNanosecondsPerSecond, imu, wheels);
  EXPECT_LT((rover.T_world_body().translation - start.translation).norm(), 0.0001);
  ASSERT_EQ(imu.size(), 200u);
  for (const ImuSample& sample : imu) {
    // Gravity only; its direction tilts with the body by less than 0.002 rad.
    EXPECT_NEAR(sample.specific_force.z(), 9.81, 0.001);
    EXPECT_LT(sample.specific_force.head<2>().norm(), 0.002 * 9.81);
    EXPECT_LT(sample.angular_velocity.norm(), 0.001);
  }
  for (const double angle : wheels.back().angle) EXPECT_NEAR(angle, 0, 0.001);
}

TEST(RoverTest, SamplesComeOnceEachAtTheirExactStamps) {
  Rover rover(test::csl_rover(), test::field(), {0, 0, 0}, 1);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  for (int frame = 1; frame <= 15; ++frame) {
    rover.advance_to(stamp_of_frame(frame, test::kRoverFrameRate), imu, wheels);
    EXPECT_LE(imu.back().stamp, rover.now());
    EXPECT_GT(imu.back().stamp + 5'000'000, rover.now());
  }
  ASSERT_EQ(imu.size(), 200u);
  ASSERT_EQ(wheels.size(), 100u);
  for (std::size_t i = 0; i < imu.size(); ++i) {
    EXPECT_EQ(imu[i].stamp, static_cast<Stamp>(i + 1) * 5'000'000);
  }
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    EXPECT_EQ(wheels[i].stamp, static_cast<Stamp>(i + 1) * 10'000'000);
  }
  EXPECT_THROW(rover.advance_to(0, imu, wheels), Error);
}

TEST(RoverTest, SamplesBetweenPhysicsStepsAreOfTheirInstant) {
  RoverConfig odd = test::csl_rover();
  odd.wheel_rate_hz = 37;
  Rover rover(odd, test::field(), {0, 0, 0}, 1);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  rover.command({0.3, 0, 0});
  rover.advance_to(3 * kNanosecondsPerSecond, imu, wheels);
  // At 3 rad/s a sample 1 ms off would be 3 mrad off.
  for (std::size_t i = 74; i + 1 < wheels.size(); ++i) {
    const double dt = to_seconds(wheels[i + 1].stamp - wheels[i].stamp);
    EXPECT_NEAR(wheels[i + 1].angle[0] - wheels[i].angle[0], 3 * dt, 0.001);
  }
}

TEST(RoverTest, TruthIsOfTheInstantHoweverItIsReached) {
  Rover in_one(test::csl_rover(), test::field(), {0, 0, 0}, 1);
  Rover in_bits(test::csl_rover(), test::field(), {0, 0, 0}, 1);
  std::vector<ImuSample> imu_one, imu_bits;
  std::vector<WheelSample> wheels_one, wheels_bits;
  in_one.command({0.3, 0.1, 0.5});
  in_bits.command({0.3, 0.1, 0.5});
  const Stamp end = from_seconds(0.9876543);
  in_one.advance_to(end, imu_one, wheels_one);
  for (Stamp t = 0; t < end; t += 1'234'567) in_bits.advance_to(t, imu_bits, wheels_bits);
  in_bits.advance_to(end, imu_bits, wheels_bits);
  EXPECT_EQ(in_one.T_world_body().matrix(), in_bits.T_world_body().matrix());
  ASSERT_EQ(imu_one.size(), imu_bits.size());
  EXPECT_EQ(imu_one.back().specific_force, imu_bits.back().specific_force);
  // Steady motion of 0.32 m/s: 1 ns later is 0.3 nm further, not a step of 0.8 mm.
  const Pose before = in_one.T_world_body();
  in_one.advance_to(end + 1, imu_one, wheels_one);
  EXPECT_LT((in_one.T_world_body().translation - before.translation).norm(), 1e-8);
}

/// Rollers shake the rover; what the unit reads sums up to its motion all the same.
TEST(RoverTest, InertialReadingsSumUpToTheMotion) {
  Rover rover(test::csl_rover(), test::field(), {0, 0, 0}, 1);
  std::vector<WheelSample> wheels;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  constexpr Stamp kPeriod = kNanosecondsPerSecond / 200;
  const Eigen::Vector3d start = rover.T_world_body().translation;
  rover.command({0.4, 0.1, 0});
  for (Stamp t = kPeriod; t <= 3 * kNanosecondsPerSecond; t += kPeriod) {
    std::vector<ImuSample> imu;
    const Pose before = rover.T_world_body();
    rover.advance_to(t, imu, wheels);
    ASSERT_EQ(imu.size(), 1u);
    velocity += (interpolate(before, rover.T_world_body(), 0.25).rotation * imu[0].specific_force -
                 Eigen::Vector3d(0, 0, 9.81)) *
                to_seconds(kPeriod);
    way += velocity * to_seconds(kPeriod);
  }
  // In steps of 2.5 ms the body's acceleration is that at their beginning, in its axes there: a
  // quarter of a reading in the mean.
  EXPECT_LT((rover.T_world_body().translation - start - way).norm(), 0.01);  // m
}

TEST(RoverTest, SameInputsGiveTheSameBits) {
  std::vector<ImuSample> imu[3];
  std::vector<WheelSample> wheels[3];
  Eigen::Matrix4d end[3];
  for (int i = 0; i < 3; ++i) {
    Rover rover(test::csl_rover(), test::field(), {0, 0, 0}, i == 2 ? 6 : 5);
    rover.command({0.3, -0.2, 0.4});
    rover.advance_to(2 * kNanosecondsPerSecond, imu[i], wheels[i]);
    end[i] = rover.T_world_body().matrix();
  }
  EXPECT_EQ(end[0], end[1]);
  ASSERT_EQ(imu[0].size(), imu[1].size());
  for (std::size_t i = 0; i < imu[0].size(); ++i) {
    EXPECT_EQ(imu[0][i].specific_force, imu[1][i].specific_force);
    EXPECT_EQ(imu[0][i].angular_velocity, imu[1][i].angular_velocity);
  }
  for (std::size_t i = 0; i < wheels[0].size(); ++i) {
    EXPECT_EQ(wheels[0][i].angle, wheels[1][i].angle);
  }
  // Another seed is another rover, but only a little.
  EXPECT_NE(end[0], end[2]);
  EXPECT_LT((end[0] - end[2]).norm(), 0.02);
}

TEST(RoverTest, FollowsARouteWithinACentimetre) {
  RouteConfig config;
  const auto add = [&config](double x, double y, double heading_deg, bool pass = false) {
    RouteConfig::Waypoint waypoint;
    waypoint.position = {x, y};
    waypoint.heading_deg = heading_deg;
    waypoint.pass = pass;
    config.waypoints.push_back(waypoint);
  };
  add(0, 0, 0);
  add(2, 0, 0);
  add(2.4, 0.8, 90, true);
  add(2, 1.6, 180);
  add(0.5, 1.6, 180);
  add(0.5, 1.6, 360);
  add(0.5, 0.8, 360);
  const Route route(config);
  EXPECT_GT(route.length(), 6);
  Rover rover(test::csl_rover(), test::field(), route.start(), 2);
  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  double worst = 0;
  double worst_turn = 0;
  for (int i = 0; rover.now() < route.duration(); ++i) {
    const Route::Reference reference = route.at(rover.now());
    const Pose body = rover.T_world_body();
    worst = std::max(worst, (test::position_of(rover) - reference.pose.head<2>()).norm());
    worst_turn = std::max(
        worst_turn,
        std::abs(std::remainder(yaw_of(body.rotation) - reference.pose.z(), 2 * std::numbers::pi)));
    rover.command(follow(reference, body));
    rover.advance_to(stamp_of_frame(i + 1, 50), imu, wheels);
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(worst_turn, 1.5 * std::numbers::pi / 180);
  EXPECT_LT((test::position_of(rover) - Eigen::Vector2d(0.5, 0.8)).norm(), 0.01);
}

TEST(RoverTest, ErrorsNameWhatIsWrong) {
  RoverConfig missing = test::csl_rover();
  missing.model = "/nowhere/rover.xml";
  EXPECT_THAT(
      [&] {
        Rover(missing, test::field(), {0, 0, 0}, 1);
      },
      ThrowsMessage<Error>(HasSubstr("/nowhere/rover.xml")));

  const test::TestFolder folder;
  RoverConfig broken = test::csl_rover();
  broken.model = folder / "broken.xml";
  write_file_atomically(broken.model,
                        "<mujoco><worldbody><geom tpye=\"box\"/></worldbody></mujoco>");
  EXPECT_THAT(
      [&] {
        Rover(broken, test::field(), {0, 0, 0}, 1);
      },
      ThrowsMessage<Error>(testing::AllOf(HasSubstr("broken.xml"), HasSubstr("tpye"))));

  RoverConfig wheelless = test::csl_rover();
  wheelless.model = folder / "wheelless.xml";
  write_file_atomically(wheelless.model,
                        "<mujoco><worldbody><body><freejoint name=\"chassis\"/>"
                        "<geom size=\"0.1\"/></body></worldbody></mujoco>");
  EXPECT_THAT(
      [&] {
        Rover(wheelless, test::field(), {0, 0, 0}, 1);
      },
      ThrowsMessage<Error>(HasSubstr("wheelless.xml")));

  // Its parts meet one another where the model does not forbid it.
  std::string text = read_file(test::csl_rover().model);
  const std::string forbids = "<geom contype=\"0\" conaffinity=\"0\" rgba=\"0.25 0.27 0.30 1\"/>";
  ASSERT_NE(text.find(forbids), std::string::npos);
  RoverConfig tangled = test::csl_rover();
  tangled.model = folder / "tangled.xml";
  write_file_atomically(tangled.model, text.erase(text.find(forbids), forbids.size()));
  EXPECT_THAT(
      [&] {
        Rover(tangled, test::field(), {0, 0, 0}, 1);
      },
      ThrowsMessage<Error>(HasSubstr("collides with itself: bodies ")));

  RoverConfig wide = test::csl_rover();
  wide.half_track = 0.25;
  EXPECT_THAT(
      [&] {
        Rover(wide, test::field(), {0, 0, 0}, 1);
      },
      ThrowsMessage<Error>(testing::AllOf(HasSubstr("front_left"), HasSubstr("half_track"))));

  EXPECT_THAT(
      [&] {
        Rover(test::csl_rover(), test::field(), {0, 10, 0}, 1);
      },
      ThrowsMessage<Error>(HasSubstr("cannot start at (0.000, 10.000) m")));
}

}  // namespace
}  // namespace vinebench::sim
