// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/findings/error_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Ten frames a second: a second at rest, four seconds ahead at 0.5 m/s, four to the left, so that
/// velocity, displacement and path length have different shapes. The estimate is `estimate_at`.
class ErrorPatternTest : public testing::Test {
 protected:
  static Pose truth_at(std::int64_t frame) {
    const auto steps = [](std::int64_t count) { return 0.05 * static_cast<double>(count); };
    Pose pose;
    pose.translation.x() = steps(std::clamp<std::int64_t>(frame - 10, 0, 40));
    pose.translation.y() = steps(std::clamp<std::int64_t>(frame - 50, 0, 40));
    return pose;
  }

  template <class EstimateAt>
  std::vector<ErrorPattern> patterns(const EstimateAt& estimate_at) {
    RunRecord record;
    record.rig = test::fake_rig();
    for (std::int64_t i = 0; i <= 90; ++i) {
      Tick tick;
      tick.index = i;
      tick.stamp = stamp_of_frame(i, 10);
      tick.truth.T_world_body = truth_at(i);
      tick.estimate.stamp = tick.stamp;
      tick.estimate.status = TrackingStatus::kTracking;
      tick.estimate.T_map_body = estimate_at(i);
      record.summary.trajectory.push_back({tick.stamp, *tick.estimate.T_map_body});
      record.ticks.push_back(tick);
    }
    record.summary.T_world_map = T_world_map_;
    results_.corrected = evaluate(true_trajectory(record), record.summary.trajectory);
    return error_patterns(record, results_);
  }

  std::optional<Pose> T_world_map_;
  RunResults results_;
};

TEST_F(ErrorPatternTest, NoErrorHasNone) {
  EXPECT_TRUE(patterns(truth_at).empty());
}

// One frame is 100 ms. At the three corners the velocity of neighbouring frames differs from the
// step between them, by half a step of 81 moving ones each: the fit explains all but 2 %.
TEST_F(ErrorPatternTest, APoseOfTheFrameBeforeIsLate) {
  const auto found =
      patterns([](std::int64_t i) { return truth_at(std::max<std::int64_t>(i, 1) - 1); });
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, ErrorPatternKind::kLate);
  EXPECT_NEAR(found[0].size, 0.1, 0.002);
  EXPECT_GT(found[0].share, 0.97);
  EXPECT_THAT(text_of(found[0]), HasSubstr("100 ms late"));
}

TEST_F(ErrorPatternTest, DistancesThatAreTooLargeAreScale) {
  const auto found = patterns([](std::int64_t i) {
    Pose pose = truth_at(i);
    pose.translation *= 1.01;
    return pose;
  });
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, ErrorPatternKind::kScale);
  EXPECT_NEAR(found[0].size, 0.01, 1e-9);
  EXPECT_NEAR(found[0].share, 1, 1e-9);
  EXPECT_THAT(text_of(found[0]), HasSubstr("scale +1.0 %"));
}

// A rotation by a small angle moves a point at distance d by the angle times d, to second order.
TEST_F(ErrorPatternTest, APathAtAnAngleIsTurned) {
  const double angle = std::numbers::pi / 180;
  const auto found = patterns([&](std::int64_t i) {
    return Pose{exp_so3({0, 0, angle}), Eigen::Vector3d::Zero()} *
           Pose{Eigen::Quaterniond::Identity(), truth_at(i).translation} *
           Pose{exp_so3({0, 0, -angle}), Eigen::Vector3d::Zero()};
  });
  // The first pose is not turned, so that aligning it does not turn the path back.
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, ErrorPatternKind::kTurned);
  EXPECT_NEAR(found[0].size, angle, angle * angle);
}

// 4 m of path: 4 cm at the end.
TEST_F(ErrorPatternTest, HeightThatGrowsWithThePathIsClimbing) {
  const auto found = patterns([](std::int64_t i) {
    Pose pose = truth_at(i);
    pose.translation.z() = 0.01 * (pose.translation.x() + pose.translation.y());
    return pose;
  });
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, ErrorPatternKind::kClimbing);
  EXPECT_NEAR(found[0].size, 0.01, 1e-9);
}

// 4 m of path: 4 cm to the left at the end.
TEST_F(ErrorPatternTest, AnErrorThatGrowsInOneDirectionIsDrifting) {
  const auto found = patterns([](std::int64_t i) {
    Pose pose = truth_at(i);
    pose.translation.y() += 0.01 * (truth_at(i).translation.x() + truth_at(i).translation.y());
    return pose;
  });
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, ErrorPatternKind::kDrifting);
  EXPECT_NEAR(found[0].size, 0.01, 1e-9);
}

// 4 m of path: 0.4 degrees at the end, and 0.2, which is not enough.
TEST_F(ErrorPatternTest, AHeadingWhoseErrorGrowsIsTurning) {
  const auto turning = [](double degrees_a_metre) {
    return [=](std::int64_t i) {
      Pose pose = truth_at(i);
      const double path = pose.translation.x() + pose.translation.y();
      pose.rotation = exp_so3({0, 0, degrees_a_metre * path * std::numbers::pi / 180});
      return pose;
    };
  };
  const auto found = patterns(turning(0.1));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, ErrorPatternKind::kTurning);
  EXPECT_NEAR(found[0].size, 0.1 * std::numbers::pi / 180, 1e-9);
  EXPECT_TRUE(patterns(turning(0.05)).empty());
}

TEST_F(ErrorPatternTest, AStepHasItsSizeAndTime) {
  const auto found = patterns([](std::int64_t i) {
    Pose pose = truth_at(i);
    if (i >= 45) pose.translation.z() += 0.02;
    return pose;
  });
  const auto step = std::ranges::find(found, ErrorPatternKind::kStep, &ErrorPattern::kind);
  ASSERT_NE(step, found.end());
  EXPECT_NEAR(step->size, 0.02, 1e-12);
  EXPECT_EQ(step->stamp, stamp_of_frame(45, 10));
}

TEST_F(ErrorPatternTest, AStepBelowFiveMillimetresIsNone) {
  const auto found = patterns([](std::int64_t i) {
    Pose pose = truth_at(i);
    if (i >= 45) pose.translation.z() += 0.0049;
    return pose;
  });
  EXPECT_EQ(std::ranges::find(found, ErrorPatternKind::kStep, &ErrorPattern::kind), found.end());
}

TEST_F(ErrorPatternTest, AMapThatIsElsewhereIsOffInTheWorld) {
  T_world_map_ = Pose{exp_so3({0, 0, 5 * std::numbers::pi / 180}), {0.06, 0, 0}};
  const auto found = patterns(truth_at);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].kind, ErrorPatternKind::kWorldOffset);
  EXPECT_NEAR(found[0].size, 0.06, 1e-12);
  EXPECT_EQ(found[1].kind, ErrorPatternKind::kWorldTurn);
  EXPECT_NEAR(found[1].size, 5 * std::numbers::pi / 180, 1e-12);
}

// The error is the same in the world as with the first poses aligned.
TEST_F(ErrorPatternTest, AScaleIsNoOffsetInTheWorld) {
  T_world_map_ = Pose{};
  const auto found = patterns([](std::int64_t i) {
    Pose pose = truth_at(i);
    pose.translation *= 1.01;
    return pose;
  });
  EXPECT_EQ(std::ranges::find(found, ErrorPatternKind::kWorldOffset, &ErrorPattern::kind),
            found.end());
}

// 4 mm up and 4 mm down in turns.
TEST_F(ErrorPatternTest, ErrorsThatDoNotLastAreNoise) {
  const auto up_and_down = [](double size) {
    return [size](std::int64_t frame) {
      Pose pose = truth_at(frame);
      pose.translation.z() += frame % 2 == 0 ? size : -size;
      return pose;
    };
  };
  const auto found = patterns(up_and_down(0.004));
  ASSERT_THAT(found, testing::Not(testing::IsEmpty()));
  EXPECT_EQ(found[0].kind, ErrorPatternKind::kNoise);
  EXPECT_NEAR(found[0].size, 0.004, 1e-5);  // m; 46 up and 45 down: the mean is not quite zero
  EXPECT_TRUE(patterns(up_and_down(0.0019)).empty());
}

// About the forward axis; positions are right.
TEST_F(ErrorPatternTest, ARollThatStaysIsTilted) {
  const auto rolled = [](double degrees) {
    return [degrees](std::int64_t frame) {
      Pose pose = truth_at(frame);
      if (frame > 0) pose.rotation = exp_so3({degrees * std::numbers::pi / 180, 0, 0});
      return pose;
    };
  };
  const auto found = patterns(rolled(0.5));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, ErrorPatternKind::kTilted);
  EXPECT_NEAR(found[0].size, 0.5 * std::numbers::pi / 180 * std::sqrt(90.0 / 91), 1e-6);
  EXPECT_TRUE(patterns(rolled(0.2)).empty());
}

// A mean NEES of 24 is four times the six degrees of freedom.
TEST_F(ErrorPatternTest, CovariancesThatDoNotFitTheErrorsAreNamed) {
  results_.consistency = Consistency{.frames = 91, .nees_mean = 24};
  EXPECT_EQ(patterns(truth_at).at(0).kind, ErrorPatternKind::kOverconfident);
  results_.consistency->nees_mean = 23.9;
  EXPECT_TRUE(patterns(truth_at).empty());
  results_.consistency->nees_mean = 1.5;
  EXPECT_EQ(patterns(truth_at).at(0).kind, ErrorPatternKind::kUnderconfident);
}

TEST_F(ErrorPatternTest, LossesAndLoopsAreCounted) {
  results_.losses = 2;
  results_.loops.missed.resize(1);
  const auto found = patterns(truth_at);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(text_of(found[0]), "lost 2 times");
  EXPECT_EQ(text_of(found[1]), "1 missed loop closures");
}

}  // namespace
}  // namespace vinebench::harness
