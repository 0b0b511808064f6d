// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/error.h"
#include "harness/judge/verdict.h"
#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

using test::record_of;

void lose(Estimate& estimate) {
  estimate.status = TrackingStatus::kLost;
  estimate.T_map_body.reset();
  estimate.keyframe = false;
}

/// Inliers of the front pair fall from 160 to 8 while blind; lost from 9 s to 10 s.
void blind_and_lost(Estimate& estimate) {
  const double t = to_seconds(estimate.stamp);
  if (t >= 8 && t <= 12) estimate.cameras[0].inliers = estimate.cameras[1].inliers = 4;
  if (t >= 9 && t <= 10) lose(estimate);
}

Expectations everything() {
  Expectations expectations;
  expectations.coverage_min = 1;
  expectations.losses_max = 0;
  expectations.ate_rmse_max = 0.01;
  expectations.ate_origin_rmse_max = 0.01;
  expectations.loop_closures_correct_min = 1;
  expectations.loop_closures_wrong_max = 0;
  expectations.loop_closures_missed_max = 0;
  expectations.blind = {.cameras = {"front_left", "front_right"}, .inliers_drop = 0.9};
  return expectations;
}

Trial asking(const Expectations& expectations) {
  Trial trial = test::fake_trial();
  trial.expectations = expectations;
  return trial;
}

TEST(ResultsTest, PerfectRunHasNoErrors) {
  const RunResults results = measure(record_of({}), {});
  EXPECT_EQ(results.coverage, 1);
  EXPECT_EQ(results.losses, 0);
  EXPECT_EQ(results.lost_frames, 0);
  EXPECT_NEAR(results.corrected.value().ate.rmse, 0, 1e-12);
  EXPECT_NEAR(results.live.value().origin.rmse, 0, 1e-12);
  EXPECT_FALSE(results.blind);
}

TEST(ResultsTest, CountsLosses) {
  const RunResults results = measure(record_of(blind_and_lost), {});
  EXPECT_EQ(results.losses, 1);
  EXPECT_EQ(results.lost_frames, 11);  // 9.0, 9.1, …, 10.0 s
  EXPECT_DOUBLE_EQ(results.coverage, 190.0 / 201);
}

TEST(ResultsTest, InitialisingIsNotLost) {
  const RunResults results = measure(record_of([](Estimate& estimate) {
                                       if (estimate.stamp > test::seconds(1)) return;
                                       lose(estimate);
                                       estimate.status = TrackingStatus::kInitializing;
                                     }),
                                     {});
  EXPECT_EQ(results.losses, 0);
  EXPECT_EQ(results.lost_frames, 0);
  EXPECT_DOUBLE_EQ(results.coverage, 190.0 / 201);
}

// The estimate's circle is 1 % larger. Aligned, every pose is 0.01 m off (a closed circle's centre
// of mass does not move, except for the doubled first point).
TEST(ResultsTest, LiveAndCorrectedAreJudgedApart) {
  RunRecord record = record_of({});
  for (StampedPose& stamped : record.summary.trajectory) {
    const Pose world = test::circle(0) * stamped.pose;
    stamped.pose = Pose{world.rotation, 1.01 * world.translation};
  }
  const RunResults results = measure(record, {});
  EXPECT_NEAR(results.corrected.value().ate.rmse, 0.01, 1e-4);
  EXPECT_NEAR(results.live.value().ate.rmse, 0, 1e-12);
}

TEST(ResultsTest, MeasuresTheOcclusion) {
  const RunResults results = measure(record_of(blind_and_lost), asking(everything()));
  ASSERT_TRUE(results.blind);
  const OcclusionSegment& blind = *results.blind;
  EXPECT_EQ(blind.first, 80u);
  EXPECT_EQ(blind.last, 120u);
  EXPECT_DOUBLE_EQ(blind.seconds, 4);
  // 40 chords of 0.1 s at a turn in 20 s: 2 sin(pi / 200) each.
  EXPECT_NEAR(blind.metres, 40 * 2 * std::sin(std::numbers::pi / 200), 1e-9);
  EXPECT_DOUBLE_EQ(blind.inliers_clear, 160);
  EXPECT_DOUBLE_EQ(blind.inliers_blind, 8);
  EXPECT_DOUBLE_EQ(blind.inliers_drop().value(), 0.95);
  EXPECT_EQ(blind.lost_frames, 11);
}

TEST(ResultsTest, StandingInFrontOfTheBoxDoesNotCount) {
  RunRecord record = record_of({});
  const Pose stopped = record.ticks[100].truth.T_world_body;
  for (std::size_t i = 100; i < 200; ++i) record.ticks[i].truth.T_world_body = stopped;
  EXPECT_DOUBLE_EQ(measure(record, asking(everything())).blind.value().seconds, 2);  // 8 s to 10 s
}

// The circle's last point is its first, (1, 0).
TEST(ResultsTest, MeasuresHowFarFromTheRoutesEndTheBodyStops) {
  Trial trial = test::fake_trial();
  EXPECT_FALSE(measure(record_of({}), trial).end_error);
  trial.route_end = {1.03, -0.04};
  const RunResults results = measure(record_of({}), trial);
  EXPECT_NEAR(results.end_error.value(), 0.05, 1e-12);
  trial.expectations.end_error_max = 0.04;
  EXPECT_FALSE(all_hold(check_expectations(trial.expectations, results)));
}

TEST(ResultsTest, UnknownCameraIsAnError) {
  Expectations expectations = everything();
  expectations.blind->cameras = {"top"};
  EXPECT_THAT([&] { measure(record_of({}), asking(expectations)); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("no camera 'top'")));
}

TEST(ResultsTest, AnEmptyRecordIsMeasured) {
  const RunResults results = measure({}, {});
  EXPECT_EQ(results.coverage, 0);
  EXPECT_FALSE(results.corrected);
}

// The estimate stands still. From (1, 0) on the circle, the rover is 2 m away after half a turn, at
// 10 s; the distance after t s is 2 sin(pi t / 20).
TEST(ResultsTest, DriftEndsWithTheFirstClosure) {
  const auto standing = [](double closed_at) {
    return measure(record_of([=](Estimate& estimate) {
                     if (estimate.stamp == test::seconds(closed_at)) {
                       estimate.loop_closure = test::fake_closure(0, estimate.stamp);
                     }
                     estimate.T_map_body = Pose{};
                   }),
                   {});
  };
  EXPECT_NEAR(standing(5).drift.value().error, 2 * std::sin(std::numbers::pi * 4.9 / 20), 1e-9);
  EXPECT_NEAR(standing(19).drift.value().error, 2, 1e-9);
  EXPECT_NEAR(standing(99).drift.value().error, 2, 1e-9);  // no closure at all
}

// The map's frame is the first body's, at (1, 0): in the world it is where the system says.
TEST(ResultsTest, TheWorldIsTheSystemsOwn) {
  RunRecord record = record_of({});
  EXPECT_FALSE(measure(record, {}).corrected.value().world);
  record.summary.T_world_map =
      Pose{Eigen::Quaterniond::Identity(), {0, 0.03, 0.04}} * test::circle(0);
  EXPECT_NEAR(measure(record, {}).corrected->world.value().position.rmse, 0.05, 1e-12);
}

}  // namespace
}  // namespace vinebench::harness
