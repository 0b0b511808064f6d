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

/// Five poses at the origin's height, a metre apart along x, of these headings, degrees.
Trajectory heading_to(const std::vector<double>& headings_deg, double pitch_deg = 0) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < headings_deg.size(); ++i) {
    constexpr double kDegree = std::numbers::pi / 180;
    trajectory.push_back(
        {static_cast<Stamp>(i) * kNanosecondsPerSecond,
         Pose{from_roll_pitch_yaw({0, pitch_deg * kDegree, headings_deg[i] * kDegree}),
              {static_cast<double>(i), 0, 0}}});
  }
  return trajectory;
}

constexpr double kAngleRounding = 1e-9;  // rad

// Errors of 0, 3, 0 and -4 degrees across the wrap of 180: rmse sqrt((9 + 16) / 4) = 2.5.
TEST(OrientationTest, HeadingIsTheAngleSeenFromAbove) {
  const auto errors = orientation_errors(
      associate(heading_to({0, 179, 90, -178}), heading_to({0, -178, 90, 178})), Pose{});
  EXPECT_NEAR(errors.heading.rmse, 2.5 * std::numbers::pi / 180, kAngleRounding);
  EXPECT_NEAR(errors.heading.max, 4 * std::numbers::pi / 180, kAngleRounding);
  EXPECT_NEAR(errors.tilt.max, 0, kAngleRounding);
}

// A body pitched by 2 degrees everywhere: the vertical is 2 degrees off, whatever its heading.
TEST(OrientationTest, TiltIsTheAngleOfTheVertical) {
  const auto errors = orientation_errors(
      associate(heading_to({0, 45, 90, 180}), heading_to({0, 45, 90, 180}, 2)), Pose{});
  EXPECT_NEAR(errors.tilt.rmse, 2 * std::numbers::pi / 180, kAngleRounding);
  EXPECT_NEAR(errors.tilt.max, 2 * std::numbers::pi / 180, kAngleRounding);
  EXPECT_NEAR(errors.heading.max, 0, kAngleRounding);
}

// A tag surveyed 6 cm aside and turned by 5 degrees about the origin moves the whole map: aligned
// there is no error. In the world the pose at distance d is off by (0, 0.06) and by 2 d sin(2.5
// deg) along the chord, which is at 92.5 degrees: by components (-c d sin 2.5, 0.06 + c d cos 2.5)
// with c = 2 sin 2.5.
TEST(EvaluateTest, InTheWorldNothingIsAligned) {
  const Trajectory truth = through({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  const double turn = 5 * std::numbers::pi / 180;
  const Pose wrong{from_roll_pitch_yaw({0, 0, turn}), {0, 0.06, 0}};
  const auto evaluation = evaluate(truth, truth, wrong);
  ASSERT_TRUE(evaluation && evaluation->world);
  EXPECT_NEAR(evaluation->ate.max, 0, kRounding);
  EXPECT_NEAR(evaluation->origin.max, 0, kRounding);
  const double half = turn / 2;
  double squares = 0;
  for (int d = 0; d < 4; ++d) {
    const double chord = 2 * d * std::sin(half);
    squares += std::pow(chord * std::sin(half), 2) + std::pow(0.06 + chord * std::cos(half), 2);
  }
  EXPECT_NEAR(evaluation->world->position.rmse, std::sqrt(squares / 4), kRounding);
  EXPECT_NEAR(evaluation->world->orientation.heading.rmse, turn, kAngleRounding);
  EXPECT_FALSE(evaluate(truth, truth)->world);
}

// Aligned by the first pose, the third is 0.3 m off and the others less.
TEST(EvaluateTest, NamesTheWorstFrame) {
  const auto evaluation = evaluate(through({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}),
                                   through({{0, 0, 0}, {1, 0.1, 0}, {2, 0, -0.3}, {3, 0.2, 0}}));
  ASSERT_TRUE(evaluation);
  EXPECT_EQ(evaluation->worst.stamp, 2 * kNanosecondsPerSecond);
  EXPECT_NEAR(evaluation->worst.error, 0.3, kRounding);
}

// Errors of 0, 0.02, 0.06, 0.04 m and, corrected by a closure at 4 s, 0: the largest before it is
// 0.06 m, on 3 m. Before 2 s it is 0.02 m on 1 m.
TEST(DriftTest, IsTheLargestErrorBeforeAClosure) {
  const Trajectory truth = through({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}});
  const Trajectory live = through({{0, 0, 0}, {1, 0.02, 0}, {2, 0.06, 0}, {3, 0.04, 0}, {4, 0, 0}});
  const auto drift = drift_before(4 * kNanosecondsPerSecond, truth, live);
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->error, 0.06, kRounding);
  EXPECT_NEAR(drift->percent, 2, 100 * kRounding);
  const auto early = drift_before(2 * kNanosecondsPerSecond, truth, live);
  EXPECT_NEAR(early->error, 0.02, kRounding);
  EXPECT_NEAR(early->percent, 2, 100 * kRounding);
  EXPECT_FALSE(drift_before(kNanosecondsPerSecond, truth, live));  // one pose
}

}  // namespace
}  // namespace vinebench::harness
