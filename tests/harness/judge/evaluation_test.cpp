// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace vinebench::harness {
namespace {

constexpr double kRounding = 1e-12;  // m

Trajectory through(const std::vector<Eigen::Vector3d>& points) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < points.size(); ++i) {
    trajectory.push_back({static_cast<Stamp>(i) * kNanosecondsPerSecond,
                          Pose{Eigen::Quaterniond::Identity(), points[i]}});
  }
  return trajectory;
}

Trajectory moved(const Trajectory& trajectory, const Pose& T_map_world) {
  Trajectory result;
  for (const auto& [stamp, pose] : trajectory) result.push_back({stamp, T_map_world * pose});
  return result;
}

TEST(AssociateTest, TakesTheNearestWithinTolerance) {
  const Trajectory truth = through({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  Trajectory estimate = through({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  estimate[0].stamp += 9'000'000;   // 9 ms late: a pair
  estimate[1].stamp -= 10'000'000;  // 10 ms early: just a pair
  estimate[2].stamp += 11'000'000;  // 11 ms late: none
  const std::vector<PosePair> pairs = associate(truth, estimate);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].stamp, 0);
  EXPECT_EQ(pairs[1].stamp, kNanosecondsPerSecond);
  EXPECT_TRUE(associate(truth, {}).empty());
  EXPECT_TRUE(associate({}, truth).empty());
}

TEST(EvaluateTest, RigidMotionOfTheMapIsNoError) {
  const Trajectory truth = through({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}, {3, 1, 2}});
  const Pose T_map_world{from_roll_pitch_yaw({0.3, -0.5, 2.0}), {5, -3, 1}};
  const auto evaluation = evaluate(truth, moved(truth, T_map_world));
  ASSERT_TRUE(evaluation);
  EXPECT_EQ(evaluation->pairs, 5u);
  EXPECT_NEAR(evaluation->ate.max, 0, kRounding);
  EXPECT_NEAR(evaluation->origin.max, 0, kRounding);
  EXPECT_NEAR(evaluation->rpe_trans_percent.value(), 0, 100 * kRounding);
}

// On a line, truth at -1, 0, 1 and estimate at -1.3, 0, 1.3 (scale is not corrected): the centres
// agree, so the aligned errors are 0.3, 0, 0.3; rmse sqrt(0.18 / 3), mean 0.2, median and max 0.3.
TEST(EvaluateTest, ScaleIsKept) {
  const auto evaluation = evaluate(through({{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}),
                                   through({{-1.3, 0, 0}, {0, 0, 0}, {1.3, 0, 0}}));
  ASSERT_TRUE(evaluation);
  EXPECT_NEAR(evaluation->ate.rmse, std::sqrt(0.18 / 3), kRounding);
  EXPECT_NEAR(evaluation->ate.mean, 0.2, kRounding);
  EXPECT_NEAR(evaluation->ate.median, 0.3, kRounding);
  EXPECT_NEAR(evaluation->ate.max, 0.3, kRounding);
  // Aligned by the first pose: errors 0, 0.3, 0.6.
  EXPECT_NEAR(evaluation->origin.rmse, std::sqrt((0.09 + 0.36) / 3), kRounding);
}

// A square whose estimate is rotated by 10 degrees about its first corner. SE(3) alignment removes
// all of it; the first pose has the same rotation, so origin alignment removes it too. With the
// first pose's rotation kept true, a corner at distance d is off by 2 d sin(5 deg).
TEST(EvaluateTest, OriginAlignmentTrustsTheFirstPose) {
  const Trajectory truth = through({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const double turn = 10 * std::numbers::pi / 180;
  Trajectory estimate = moved(truth, {from_roll_pitch_yaw({0, 0, turn}), {0, 0, 0}});
  estimate[0].pose.rotation = Eigen::Quaterniond::Identity();
  const auto evaluation = evaluate(truth, estimate);
  ASSERT_TRUE(evaluation);
  EXPECT_NEAR(evaluation->ate.rmse, 0, kRounding);
  const double chord = 2 * std::sin(turn / 2);  // of distance 1; the far corner has sqrt(2)
  EXPECT_NEAR(evaluation->origin.rmse, chord * std::sqrt((0.0 + 1 + 2 + 1) / 4), kRounding);
}

// No rotation aligns mirrored points: the alignment must remain a rotation.
TEST(EvaluateTest, AlignmentIsNeverAMirror) {
  const Trajectory truth = through({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}});
  const Trajectory mirror = through({{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}});
  const auto evaluation = evaluate(truth, mirror);
  ASSERT_TRUE(evaluation);
  EXPECT_NEAR(evaluation->T_world_map.rotation.toRotationMatrix().determinant(), 1, kRounding);
  EXPECT_GT(evaluation->ate.rmse, 0.1);
}

TEST(EvaluateTest, TooFewPosesGiveNothing) {
  const Trajectory two = through({{0, 0, 0}, {1, 0, 0}});
  EXPECT_FALSE(evaluate(two, two));
  EXPECT_FALSE(evaluate(two, {}));
}

// Steps of 0.25 m, 2 % too long in the estimate: each segment of 1 m is 0.02 m off.
TEST(RelativeErrorTest, IsPercentOfTheWay) {
  std::vector<Eigen::Vector3d> truth;
  std::vector<Eigen::Vector3d> estimate;
  for (int i = 0; i <= 20; ++i) {
    truth.emplace_back(0.25 * i, 0, 0);
    estimate.emplace_back(0.255 * i, 0, 0);
  }
  const auto percent = relative_error_percent(associate(through(truth), through(estimate)));
  EXPECT_NEAR(percent.value(), 2, 1e-9);
}

// Steps of 0.3 m: 0.9 m is nearest to 1 m and within a tenth; steps of 0.6 m give 1.2 m at best.
TEST(RelativeErrorTest, SegmentsEndNearestToOneMetre) {
  const auto percent_for = [](double step) {
    std::vector<Eigen::Vector3d> truth;
    std::vector<Eigen::Vector3d> estimate;
    for (int i = 0; i <= 10; ++i) {
      truth.emplace_back(step * i, 0, 0);
      estimate.emplace_back(step * i, i % 2 == 0 ? 0.0 : 0.01, 0);
    }
    return relative_error_percent(associate(through(truth), through(estimate)));
  };
  EXPECT_NEAR(percent_for(0.3).value(), 1, 1e-9);  // three steps on, the side has changed: 0.01 m
  EXPECT_FALSE(percent_for(0.6).has_value());
}

}  // namespace
}  // namespace vinebench::harness
