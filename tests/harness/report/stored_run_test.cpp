// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/stored_run.h"

#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

RunReport report() {
  RunReport report;
  report.scenario = "row";
  report.seed = 4;
  report.results.coverage = 0.5;
  report.results.loops.missed.resize(2);
  report.checks = {{"coverage", "0.5", ">= 1", false}};
  report.cost.wall_seconds = 12;
  report.hash_environment = {{"libm", "vinebench"}, {"blas", "libblas.so"}};
  return report;
}

TEST(StoredRunTest, HasWhatTheReportHad) {
  const test::TestFolder folder;
  const auto file = folder.write("metrics.json", to_json(report()).dump(2));
  const std::optional<StoredRun> run = read_stored_run(file);
  ASSERT_TRUE(run);
  EXPECT_EQ(run->scenario, "row");
  EXPECT_EQ(run->seed, 4);
  EXPECT_EQ(run->value("/coverage"), 0.5);
  EXPECT_EQ(run->value("/wall_seconds"), 12);
  EXPECT_EQ(run->value("/loop_closures/missed"), 2);
  EXPECT_FALSE(run->value("/ate_rmse_m"));  // null
  EXPECT_FALSE(run->value("/hash"));        // text
  EXPECT_EQ(run->value(kPassedKey), 0);     // its coverage is too low
  EXPECT_EQ(run->hash(), "");
  EXPECT_EQ(run->hash_environment(), report().hash_environment);
  ASSERT_EQ(run->checks.size(), 1u);
  EXPECT_EQ(run->checks[0].what, "coverage");
  EXPECT_EQ(run->json, to_json(report()));
}

TEST(StoredRunTest, ARunWithoutExpectationsHasNoVerdict) {
  const auto run = stored_run({{"scenario", "row"}, {"seed", 1}, {"hash", "abc"}});
  EXPECT_FALSE(run->value(kPassedKey));
  EXPECT_EQ(run->hash(), "abc");
  EXPECT_EQ(StoredRun{}.hash(), "");
  EXPECT_TRUE(run->hash_environment().empty());
}

TEST(StoredRunTest, WhatIsNotARunsMetricsIsNone) {
  EXPECT_TRUE(stored_run({{"scenario", "row"}, {"seed", 1}}));
  EXPECT_FALSE(stored_run({{"scenario", "row"}}));
  EXPECT_FALSE(stored_run({{"scenario", 3}, {"seed", 1}}));
  EXPECT_FALSE(stored_run({{"scenario", "row"}, {"seed", 1.5}}));
  EXPECT_FALSE(stored_run({{"scenario", "row"}, {"seed", 1}, {"expectations", {{"what", 1}}}}));
  EXPECT_FALSE(stored_run(Json::array()));
  const test::TestFolder folder;
  EXPECT_FALSE(read_stored_run(folder / "metrics.json"));
  EXPECT_FALSE(read_stored_run(folder.write("metrics.json", "{\"scenario\": \"row\"")));
  EXPECT_FALSE(read_stored_run(folder.path()));
}

// Its numbers are found by a recursion.
TEST(StoredRunTest, AFileNestedTooDeeplyIsAnError) {
  const test::TestFolder folder;
  const int levels = 100'000;
  const auto file =
      folder.write("metrics.json", R"({"scenario": "row", "seed": 1, "x": )" +
                                       std::string(levels, '[') + std::string(levels, ']') + "}");
  EXPECT_NE(test::error_of([&] { read_stored_run(file); }).find("nested more than"),
            std::string::npos);
}

}  // namespace
}  // namespace vinebench::harness
