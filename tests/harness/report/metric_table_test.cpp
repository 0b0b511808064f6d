// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/metric_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

TEST(MetricTableTest, AreFoundInMetricsInTheirUnits) {
  const StoredRun run{.values = {{"/ate_rmse_m", 0.0123}, {"/loop_closures/wrong", 2}}};
  for (const Metric& metric : shown_metrics()) {
    const auto value = value_of(metric, run);
    if (metric.key == "/ate_rmse_m") {
      EXPECT_DOUBLE_EQ(value.value(), 12.3);  // mm
    } else if (metric.key == "/loop_closures/wrong") {
      EXPECT_EQ(value.value(), 2);
    } else {
      EXPECT_FALSE(value) << metric.key;
    }
  }
}

TEST(MetricTableTest, NamesAreThoseOfTheFile) {
  std::set<std::string> names;
  for (const Metric& metric : known_metrics()) {
    EXPECT_TRUE(metric.key.starts_with('/')) << metric.key;
    EXPECT_TRUE(names.insert(name_of(metric)).second) << metric.key;
    EXPECT_EQ(metric_named(name_of(metric)).key, metric.key);
  }
  EXPECT_EQ(metric_named("loop_closures.wrong").title, "loops wrong");
  EXPECT_THAT(test::error_of([] { metric_named("ate_rms_m"); }),
              testing::HasSubstr("did you mean 'ate_rmse_m'?"));
}

// A logarithm needs positive values: shares and counts are ordered.
TEST(MetricTableTest, SharesAndCountsAreOrdered) {
  EXPECT_EQ(metric_named("losses").compared_by, Scale::kOrdered);
  EXPECT_EQ(metric_named("coverage").compared_by, Scale::kOrdered);
  EXPECT_EQ(metric_named("ate_rmse_m").compared_by, Scale::kRatio);
}

TEST(MetricTableTest, TablesLineUp) {
  EXPECT_EQ(markdown_table({{"name", "x, mm"}, {"a", "–"}, {"longer", "12.5"}}, 1),
            "| name   | x, mm |\n"
            "|--------|------:|\n"
            "| a      |     – |\n"
            "| longer |  12.5 |\n");
}

}  // namespace
}  // namespace vinebench::harness
