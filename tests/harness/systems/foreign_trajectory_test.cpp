// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/foreign_trajectory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

const std::vector<Stamp> kFrames{0, 100'000'000, 200'000'000, 300'000'000};  // ns, 10 Hz

Trajectory read(const std::string& text, const Pose& T_sensor_body = {}) {
  const test::TestFolder folder;
  return read_foreign_trajectory(folder.write("poses.txt", text), kFrames, T_sensor_body);
}

std::string error(const std::string& text) {
  return test::error_of([&] { read(text); });
}

// A turn by 90 degrees about z has the quaternion (0, 0, sqrt(1/2), sqrt(1/2)) as x, y, z, w.
TEST(ForeignTrajectoryTest, ReadsTumInSecondsAndInNanoseconds) {
  for (const char* text : {"# a comment\n0.1 1 2 3 0 0 0.70710678 0.70710678\n",
                           "100000000 1 2 3 0 0 0.70710678 0.70710678\n",
                           "100000000.000000 1 2 3 0 0 0.70710678 0.70710678 9 9\n"}) {
    const Trajectory trajectory = read(text);
    ASSERT_EQ(trajectory.size(), 1u) << text;
    EXPECT_EQ(trajectory[0].stamp, 100'000'000);
    EXPECT_EQ(trajectory[0].pose.translation, Eigen::Vector3d(1, 2, 3));
    EXPECT_NEAR(yaw_of(trajectory[0].pose.rotation), std::numbers::pi / 2, 1e-7);
  }
}

TEST(ForeignTrajectoryTest, ReadsEurocWithTheScalarFirst) {
  const Trajectory trajectory =
      read("#timestamp,x,y,z,qw,qx,qy,qz,vx\n200000000,1,2,3,0.70710678,0,0,0.70710678,0\n");
  ASSERT_EQ(trajectory.size(), 1u);
  EXPECT_EQ(trajectory[0].stamp, 200'000'000);
  EXPECT_NEAR(yaw_of(trajectory[0].pose.rotation), std::numbers::pi / 2, 1e-7);
}

TEST(ForeignTrajectoryTest, FramesTakeTheNearestPoseAndMayHaveNone) {
  const Trajectory trajectory = read(
      "0.004 4 0 0 0 0 0 1\n"    // 4 ms late
      "0.2001 5 0 0 0 0 0 1\n"   // nearer to the third frame than the next line
      "0.1991 6 0 0 0 0 0 1\n"   // out of order
      "0.311 7 0 0 0 0 0 1\n");  // 11 ms late: of no frame
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].stamp, 0);
  EXPECT_EQ(trajectory[0].pose.translation.x(), 4);
  EXPECT_EQ(trajectory[1].stamp, 200'000'000);
  EXPECT_EQ(trajectory[1].pose.translation.x(), 5);
}

// The sensor is 0.5 m in front of the body with the same orientation: the body is 0.5 m behind it.
TEST(ForeignTrajectoryTest, PosesOfASensorBecomeTheBodys) {
  const Pose T_body_sensor{Eigen::Quaterniond::Identity(), {0.5, 0, 0}};
  const Trajectory trajectory = read("0 2 0 0 0 0 0 1\n", T_body_sensor.inverse());
  EXPECT_NEAR(trajectory.at(0).pose.translation.x(), 1.5, 1e-12);
}

TEST(ForeignTrajectoryTest, AnEmptyFileIsNoPose) {
  EXPECT_TRUE(read("").empty());
  EXPECT_TRUE(read("# nothing\n").empty());
}

TEST(ForeignTrajectoryTest, SaysWhatIsWrong) {
  EXPECT_THAT(error("0 1 2 3 0 0 0 1\n0.1 1 2 3\n"), HasSubstr("poses.txt:2: expected 8 columns"));
  EXPECT_THAT(error("0 1 2 nan 0 0 0 1\n"), HasSubstr("expected a number, found 'nan'"));
  EXPECT_THAT(error("0 1 2 3 0 0 0 2\n"), HasSubstr("expected a unit quaternion, found norm 2"));
  // As nanoseconds, because they would otherwise lie beyond the last frame; 2^62 ns are 4.6e18.
  for (const char* time : {"1e300", "9223372036854775808", "4.7e18"}) {
    EXPECT_THAT(error(std::string("0 1 2 3 0 0 0 1\n") + time + " 1 2 3 0 0 0 1\n"),
                HasSubstr(std::string("poses.txt:2: expected a time in seconds or nanoseconds, "
                                      "found '") +
                          time));
  }
  EXPECT_THAT(error("0 1 2 3 0 0 0 1\n-1e300 1 2 3 0 0 0 1\n"),
              HasSubstr("poses.txt:2: expected a time in seconds, found '-1e300'"));
  EXPECT_THAT(error("nan 1 2 3 0 0 0 1\n0 1 2 3 0 0 0 1\n"),
              HasSubstr("poses.txt:1: expected a number, found 'nan'"));
  EXPECT_THAT(error("1403636579.7 1 2 3 0 0 0 1\n"),
              HasSubstr("none of its 1 poses matches a frame: they are from 1.403636580 to"));
}

}  // namespace
}  // namespace vinebench::harness
