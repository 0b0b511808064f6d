// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/mutants/faulty_slam.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/mutants/mutant.h"

namespace vinebench::mutants {
namespace {

constexpr Stamp kSecond = kNanosecondsPerSecond;

/// 1 m/s along x, ten poses a second, for ten seconds.
Trajectory straight() {
  Trajectory trajectory;
  for (std::int64_t i = 0; i <= 100; ++i) {
    StampedPose pose{stamp_of_frame(i, 10), {}};
    pose.pose.translation.x() = 0.1 * static_cast<double>(i);
    trajectory.push_back(pose);
  }
  return trajectory;
}

/// In metres, with the middle of the run at 5 s.
Eigen::Vector3d position(Fault fault, double size, std::size_t index) {
  return misreported(straight(), index, {fault, size}, 5 * kSecond).translation;
}

void expect_at(const Eigen::Vector3d& found, double x, double y, double z) {
  EXPECT_NEAR((found - Eigen::Vector3d(x, y, z)).norm(), 0, 1e-12) << found.transpose();
}

TEST(FaultySlamTest, PosesAreWrongAsTheFaultSays) {
  expect_at(position(Fault::kScale, 0.01, 100), 10.1, 0, 0);
  expect_at(position(Fault::kLate, 0.1, 100), 9.9, 0, 0);
  expect_at(position(Fault::kLate, 0.1, 0), 0, 0, 0);
  expect_at(position(Fault::kDrift, 0.003, 100), 10, 0.03, 0);
  expect_at(position(Fault::kClimb, 0.003, 100), 10, 0, 0.03);
}

TEST(FaultySlamTest, WhatBeginsInTheMiddleBeginsThere) {
  expect_at(position(Fault::kJump, 0.02, 49), 4.9, 0, 0);
  expect_at(position(Fault::kJump, 0.02, 50), 5, 0.02, 0);
  expect_at(position(Fault::kJump, 0.02, 100), 10, 0.02, 0);
  expect_at(position(Fault::kJumpBack, 0.02, 59), 5.9, 0.02, 0);
  expect_at(position(Fault::kJumpBack, 0.02, 60), 6, 0, 0);
  expect_at(position(Fault::kFrozen, 1, 59), 5, 0, 0);
  expect_at(position(Fault::kFrozen, 1, 60), 6, 0, 0);
}

// At a constant velocity nothing is lost by assuming it.
TEST(FaultySlamTest, ASilentLossGoesOnStraight) {
  expect_at(position(Fault::kSilentLoss, 2, 60), 6, 0, 0);
  Trajectory stopped = straight();
  for (std::size_t i = 51; i <= 100; ++i) stopped[i].pose = stopped[50].pose;
  const Pose wrong = misreported(stopped, 60, {Fault::kSilentLoss, 2}, 5 * kSecond);
  expect_at(wrong.translation, 6, 0, 0);
}

TEST(FaultySlamTest, NoiseIsTheSameEachTime) {
  const Eigen::Vector3d once = position(Fault::kNoise, 0.005, 30);
  EXPECT_EQ(once, position(Fault::kNoise, 0.005, 30));
  EXPECT_GT((once - Eigen::Vector3d(3, 0, 0)).norm(), 1e-4);
}

TEST(MutantsTest, ThereAreFortyOfDifferentNames) {
  std::set<std::string> names;
  for (const Mutant& mutant : all_mutants()) names.insert(mutant.name);
  EXPECT_EQ(names.size(), all_mutants().size());
  EXPECT_GE(names.size(), 40u);
}

}  // namespace
}  // namespace vinebench::mutants
