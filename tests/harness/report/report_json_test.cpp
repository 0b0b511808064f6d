// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/report_json.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "tests/support/documented_keys.h"
#include "vinebench/version.h"

namespace vinebench::harness {
namespace {

std::vector<std::string> keys_of(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  return keys;
}

/// With everything that a report can have.
RunReport whole() {
  RunReport report;
  report.scenario = "row";
  report.seed = 4;
  report.frames = 30;
  RunResults& results = report.results;
  results.coverage = 0.5;
  results.corrected.emplace();
  results.corrected->ate.rmse = 0.25;
  results.corrected->orientation.heading.rmse = std::numbers::pi;
  results.corrected->worst = {2 * kNanosecondsPerSecond, 0.5};
  results.corrected->world.emplace().position.rmse = 0.75;
  results.drift = Drift{.error = 0.125, .percent = 1};
  results.consistency = Consistency{.frames = 3, .nees_mean = 6, .not_invertible = 2};
  results.loops.missed.resize(1);
  results.blind = OcclusionSegment{.seconds = 4, .inliers_clear = 160, .inliers_blind = 8};
  results.blind->occluder = OccluderClass::kPerson;
  report.patterns = {{ErrorPatternKind::kLate, 0.1, 0.75},
                     {ErrorPatternKind::kStep, 0.02, 1, kNanosecondsPerSecond}};
  report.keyframes = 7;
  report.cameras = {{"left", 500, 80, {}}, {"side", 0, 0, {}}};
  report.cameras[0].occlusion.share(OccluderClass::kCarton) = 0.125;
  report.input_faults = {{"unreadable", 2}};
  report.checks = {{"coverage", "0.5", ">= 1", false}};
  report.cost = {.wall_seconds = 2, .cpu_seconds = 3, .stages = {{"stereo", 1, 2, 3}}};
  report.hash = "abc";
  return report;
}

// The order is part of the file's format, and of the hash.
TEST(ReportJsonTest, HasEveryKeyInItsOrder) {
  const std::vector<std::string> expected{"scenario",
                                          "seed",
                                          "version",
                                          "frames",
                                          "coverage",
                                          "lost_frames",
                                          "losses",
                                          "ate_rmse_m",
                                          "ate_max_m",
                                          "ate_live_rmse_m",
                                          "ate_origin_rmse_m",
                                          "rpe_trans_percent",
                                          "nees_mean",
                                          "nees_within_95",
                                          "end_error_m",
                                          "loop_closures",
                                          "keyframes",
                                          "landmarks",
                                          "features",
                                          "inliers",
                                          "input_faults",
                                          "blind",
                                          "real_time_factor",
                                          "wall_seconds",
                                          "cpu_seconds",
                                          "timing_ms",
                                          "peak_rss_mib",
                                          "hash",
                                          "occlusion",
                                          "nees_left_out",
                                          "heading_rmse_deg",
                                          "heading_max_deg",
                                          "tilt_rmse_deg",
                                          "tilt_max_deg",
                                          "worst_frame",
                                          "ate_world_rmse_m",
                                          "ate_world_p95_m",
                                          "ate_world_live_rmse_m",
                                          "heading_world_rmse_deg",
                                          "tilt_world_rmse_deg",
                                          "drift_m",
                                          "drift_percent",
                                          "loop_returns",
                                          "error_patterns",
                                          "discrepancies",
                                          "expectations"};
  EXPECT_EQ(keys_of(to_json(whole())), expected);
}

// One definition each, in docs/running.md.
TEST(ReportJsonTest, EveryKeyHasOneDefinition) {
  RunReport report = whole();
  report.failure = SlamFailure{"crashed", 3};
  report.hash_environment = {{"libm", "2.36"}};
  std::set<std::string> documented;
  for (const std::string& key : test::documented_keys("| key of `metrics.json` | definition |")) {
    if (key == "metrics.json") continue;  // the header
    EXPECT_TRUE(documented.insert(key).second) << key << " is defined twice";
  }
  std::set<std::string> expected;
  for (const std::string& key : keys_of(to_json(report))) {
    if (key != "loop_closures") expected.insert(key);
  }
  for (const char* of : {"correct", "wrong", "missed"}) {
    expected.insert(std::string("loop_closures.") + of);
  }
  EXPECT_EQ(documented, expected);
}

TEST(ReportJsonTest, HasTheValues) {
  const Json json = to_json(whole());
  EXPECT_EQ(json["scenario"], "row");
  EXPECT_EQ(json["version"], kVersion);
  EXPECT_EQ(json["coverage"], 0.5);
  EXPECT_EQ(json["ate_rmse_m"], 0.25);
  EXPECT_TRUE(json["rpe_trans_percent"].is_null());
  EXPECT_TRUE(json["ate_live_rmse_m"].is_null());
  EXPECT_EQ(json["loop_closures"], Json({{"correct", 0}, {"wrong", 0}, {"missed", 1}}));
  EXPECT_EQ(json["features"], Json({{"left", 500.0}, {"side", 0.0}}));
  EXPECT_EQ(json["inliers"]["left"], 80.0);
  EXPECT_EQ(json["input_faults"], Json({{"unreadable", 2}}));
  EXPECT_EQ(json["blind"]["inliers_drop"], 0.95);  // 1 - 8 / 160
  EXPECT_EQ(json["blind"]["occluder"], "person");
  EXPECT_EQ(json["error_patterns"],
            Json({{{"pattern", "late"}, {"size", 0.1}, {"share", 0.75}},
                  {{"pattern", "step"}, {"size", 0.02}, {"share", 1.0}, {"t", 1.0}}}));
  EXPECT_EQ(json["timing_ms"]["stereo"], Json({{"mean", 1.0}, {"p50", 2.0}, {"p95", 3.0}}));
  EXPECT_EQ(json["wall_seconds"], 2);
  EXPECT_EQ(json["occlusion"], Json({{"left", {{"carton", 0.125}}}}));  // no key for the clear one
  EXPECT_EQ(json["nees_left_out"], 2);
  EXPECT_DOUBLE_EQ(json["heading_rmse_deg"], 180);  // half a turn
  EXPECT_EQ(json["worst_frame"], Json({{"error_m", 0.5}, {"t", 2.0}}));
  EXPECT_EQ(json["ate_world_rmse_m"], 0.75);
  EXPECT_EQ(json["drift_m"], 0.125);
  EXPECT_EQ(json["hash"], "abc");
}

TEST(ReportJsonTest, WhatWasNotMeasuredIsNullOrAbsent) {
  RunReport report = whole();
  report.results.corrected.reset();
  report.results.consistency->frames = 0;
  report.results.blind.reset();
  report.input_faults.clear();
  report.cameras[0].occlusion = {};
  const Json json = to_json(report);
  EXPECT_TRUE(json.at("ate_rmse_m").is_null());
  for (const char* key : {"nees_mean", "nees_within_95", "blind", "input_faults", "occlusion"}) {
    EXPECT_FALSE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["nees_left_out"], 2);
}

TEST(ReportJsonTest, TheHashedPartDependsOnResultsAlone) {
  const std::string hashed = hashed_json(whole()).dump();
  RunReport slower = whole();
  slower.cost.wall_seconds = 9;
  slower.hash = "def";
  slower.checks.clear();
  slower.cameras[0].occlusion = {};
  slower.results.blind->occluder = OccluderClass::kCrate;
  slower.results.consistency->not_invertible = 0;
  slower.results.corrected->world.reset();
  slower.results.drift.reset();
  slower.patterns.clear();
  EXPECT_EQ(hashed_json(slower).dump(), hashed);
  RunReport other = whole();
  other.landmarks += 1;
  EXPECT_NE(hashed_json(other).dump(), hashed);
}

TEST(ReportJsonTest, ChecksAreReadBack) {
  const std::vector<Check> checks =
      checks_of(checks_json({{"ATE", "0.01 m", "<= 0.02 m", true},
                             {"coverage", "0.5", ">= 1", false, CheckKind::kGuard}}));
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(checks[0].what, "ATE");
  EXPECT_EQ(checks[0].measured, "0.01 m");
  EXPECT_EQ(checks[0].expected, "<= 0.02 m");
  EXPECT_TRUE(checks[0].ok);
  EXPECT_FALSE(checks[1].ok);
  EXPECT_EQ(checks[0].kind, CheckKind::kExpectation);
  EXPECT_EQ(checks[1].kind, CheckKind::kGuard);
  // An earlier program's have no kind.
  const Json earlier{{{"what", "a"}, {"measured", "1"}, {"expected", "2"}, {"ok", true}}};
  EXPECT_EQ(checks_of(earlier).at(0).kind, CheckKind::kExpectation);
}

}  // namespace
}  // namespace vinebench::harness
