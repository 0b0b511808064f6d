// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/error.h"
#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

/// Half of the 201 frames, less one, have no inliers in the front pair.
void lose_inliers_late(Estimate& estimate) {
  if (estimate.stamp <= test::seconds(10)) return;
  estimate.cameras[0].inliers = estimate.cameras[1].inliers = 0;
}

TEST(RunReportTest, HasTheMeansOfEachCamera) {
  const RunReport report = judge(test::record_of(lose_inliers_late), test::fake_trial());
  EXPECT_EQ(report.scenario, "fake");
  EXPECT_EQ(report.seed, 1);
  EXPECT_EQ(report.frames, 201);
  EXPECT_EQ(report.keyframes, 5u);  // frames 0, 50, 100, 150, 200
  EXPECT_EQ(report.landmarks, 1234u);
  ASSERT_EQ(report.cameras.size(), 3u);
  EXPECT_EQ(report.cameras[0].name, "front_left");
  EXPECT_DOUBLE_EQ(report.cameras[0].features, 500);
  EXPECT_DOUBLE_EQ(report.cameras[1].inliers, 80 * 101 / 201.0);
  EXPECT_EQ(report.cameras[2].features, 0);
}

// Cartons cover 95 % of the front pair in the 41 frames from 8 s to 12 s.
TEST(RunReportTest, HasWhatCoveredEachCamera) {
  const RunReport report = judge(test::record_of(), test::fake_trial());
  EXPECT_NEAR(report.cameras[0].occlusion.share(OccluderClass::kCarton), 0.95 * 41 / 201, 1e-12);
  EXPECT_EQ(report.cameras[0].occlusion.share(OccluderClass::kPerson), 0);
  EXPECT_EQ(report.cameras[2].occlusion.total(), 0);
}

TEST(RunReportTest, CountsFaultsByKindInTheOrderOfTheFirst) {
  RunRecord record = test::record_of();
  record.ticks[3].events = {{"unreadable", "side", ""}, {"missing", "side", ""}};
  record.ticks[9].events = {{"unreadable", "front_left", ""}};
  const RunReport report = judge(record, test::fake_trial());
  ASSERT_EQ(report.input_faults.size(), 2u);
  EXPECT_EQ(report.input_faults[0].kind, "unreadable");
  EXPECT_EQ(report.input_faults[0].count, 2);
  EXPECT_EQ(report.input_faults[1].count, 1);
}

TEST(RunReportTest, HasVerdictAndDiagnosis) {
  Trial trial = test::fake_trial();
  trial.expectations.losses_max = 0;
  const RunReport report = judge(test::record_of([](Estimate& estimate) {
                                   if (std::abs(to_seconds(estimate.stamp) - 10) > 0.5) return;
                                   estimate.status = TrackingStatus::kLost;
                                   estimate.T_map_body.reset();
                                   estimate.keyframe = false;
                                 }),
                                 trial);
  EXPECT_EQ(report.results.losses, 1);
  ASSERT_EQ(report.checks.size(), 1u);
  EXPECT_FALSE(report.checks[0].ok);
  ASSERT_EQ(report.diagnosis.size(), 1u);
  EXPECT_EQ(report.diagnosis[0].cause, Cause::kOcclusion);
  EXPECT_EQ(report.diagnosis[0].untracked, 11);  // 9.5, 9.6, …, 10.5 s
}

TEST(RunReportTest, AnEmptyRecordHasZeros) {
  RunRecord record;
  record.rig = test::fake_rig();
  const RunReport report = judge(record, {});
  EXPECT_EQ(report.frames, 0);
  EXPECT_EQ(report.cameras.at(0).features, 0);  // and not 0 / 0
  EXPECT_FALSE(report.results.corrected);
}

}  // namespace
}  // namespace vinebench::harness
