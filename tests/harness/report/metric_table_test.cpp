// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/metric_table.h"

#include <gtest/gtest.h>

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

TEST(MetricTableTest, TablesLineUp) {
  EXPECT_EQ(markdown_table({{"name", "x, mm"}, {"a", "–"}, {"longer", "12.5"}}, 1),
            "| name   | x, mm |\n"
            "|--------|------:|\n"
            "| a      |     – |\n"
            "| longer |  12.5 |\n");
}

}  // namespace
}  // namespace vinebench::harness
