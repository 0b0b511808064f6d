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

}  // namespace
}  // namespace vinebench::harness
