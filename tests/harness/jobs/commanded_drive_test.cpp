// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/commanded_drive.h"

#include <gmock/gmock.h>

#include <limits>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/geometry/pose.h"
#include "tests/support/court_scenario.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

class CommandedDriveTest : public test::CourtScenario {
 protected:
  FramesRequest frames_request() const {
    FramesRequest request;
    request.scenario = file_;
    request.machine = machine();
    request.threads = 1;
    return request;
  }
};

bool same(const DatasetFrame& a, const DatasetFrame& b) {
  return a.truth.T_world_body.translation == b.truth.T_world_body.translation &&
         cv::norm(a.frame.images.at(0), b.frame.images.at(0), cv::NORM_INF) == 0;
}

// 0.34 s at 15 Hz: frames 0 to 5.
TEST_F(CommandedDriveTest, GivesAFrameAStepUntilItsEnd) {
  CommandedDrive drive(frames_request());
  EXPECT_EQ(drive.last_number(), 5);
  const auto first = drive.reset(std::nullopt, std::nullopt);
  EXPECT_EQ(first->number, 0);
  for (std::int64_t i = 1; i <= 5; ++i) EXPECT_EQ(drive.step({0.5, 0, 0})->number, i);
  EXPECT_EQ(drive.step({0.5, 0, 0}), nullptr);
}

TEST_F(CommandedDriveTest, AResetRepeatsToTheByte) {
  CommandedDrive drive(frames_request());
  const auto first = drive.reset(std::nullopt, std::nullopt);
  const auto moved = drive.step({0.5, 0.2, 0.1});
  EXPECT_FALSE(same(*first, *moved));
  EXPECT_TRUE(same(*first, *drive.reset(std::nullopt, std::nullopt)));
  EXPECT_TRUE(same(*moved, *drive.step({0.5, 0.2, 0.1})));
  EXPECT_EQ(drive.scenario().seed, 5);
}

// The motors differ by seed.
TEST_F(CommandedDriveTest, AnotherSeedIsAnotherRover) {
  CommandedDrive drive(frames_request());
  drive.reset(std::nullopt, std::nullopt);
  const auto five = drive.step({0.5, 0, 0});
  drive.reset(6, std::nullopt);
  EXPECT_EQ(drive.scenario().seed, 6);
  EXPECT_FALSE(same(*five, *drive.step({0.5, 0, 0})));
  drive.reset(5, std::nullopt);
  EXPECT_TRUE(same(*five, *drive.step({0.5, 0, 0})));
}

// A millimetre: it settles on its springs.
TEST_F(CommandedDriveTest, StartsWhereItIsTold) {
  CommandedDrive drive(frames_request());
  const auto frame = drive.reset(std::nullopt, Eigen::Vector3d(-0.5, -1, std::numbers::pi / 2));
  const Pose& pose = frame->truth.T_world_body;
  EXPECT_NEAR(pose.translation.x(), -0.5, 0.001);
  EXPECT_NEAR(pose.translation.y(), -1, 0.001);
  EXPECT_NEAR(yaw_of(pose.rotation), std::numbers::pi / 2, 0.001);
  const auto again = drive.reset(std::nullopt, std::nullopt);
  EXPECT_NEAR(again->truth.T_world_body.translation.x(), 0, 0.001);
}

TEST_F(CommandedDriveTest, KnowsTheScenariosRoute) {
  const std::vector<Eigen::Vector3d> route = CommandedDrive(frames_request()).route();
  ASSERT_EQ(route.size(), 2u);
  EXPECT_EQ(route[1], Eigen::Vector3d(1, 0, 0));
}

TEST_F(CommandedDriveTest, WhatCannotBeDrivenIsRefused) {
  CommandedDrive drive(frames_request());
  EXPECT_THAT(error_of([&] { drive.step({0, 0, 0}); }), HasSubstr("expected a reset before"));
  drive.reset(std::nullopt, std::nullopt);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of([&] { drive.step({0, nan, 0}); }), HasSubstr("expected finite numbers"));
  EXPECT_THAT(error_of([&] { drive.reset(std::nullopt, Eigen::Vector3d(-1, 2, 0)); }),
              HasSubstr("cannot start at (-1.000, 2.000)"));
  FramesRequest unknown = frames_request();
  unknown.cameras = {"top"};
  EXPECT_THAT(error_of([&] { CommandedDrive{unknown}; }), HasSubstr("no camera named 'top'"));
}

}  // namespace
}  // namespace vinebench::harness
