// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

TEST(HistoryTest, TheBandIsThePredictionInterval) {
  const Metric metric{.key = "/losses", .compared_by = Scale::kOrdered};
  // Mean 2, standard deviation 1, n = 3. Student's t for 99.5 % and two degrees of freedom is
  // 9.925; half the band is 9.925 * 1 * sqrt(1 + 1/3) = 11.460.
  const auto band = band_of(metric, {1, 2, 3});
  ASSERT_TRUE(band);
  EXPECT_NEAR(band->low, 2 - 11.460, 1e-3);
  EXPECT_NEAR(band->high, 2 + 11.460, 1e-3);
  EXPECT_FALSE(band_of(metric, {1, 2}));
}

TEST(HistoryTest, ErrorsAreComparedByTheirRatio) {
  const Metric metric = metric_named("ate_rmse_m");
  // Logarithms -1, 0, 1 times log 2: the band is symmetric by factors, 2^(+-11.460).
  const auto band = band_of(metric, {0.5, 1, 2});
  ASSERT_TRUE(band);
  EXPECT_NEAR(std::log2(band->high), 11.460, 1e-3);
  EXPECT_NEAR(band->low * band->high, 1, 1e-9);
}

TEST(HistoryTest, EqualFiguresAllowOnePercentOfSpread) {
  const Metric metric = metric_named("ate_rmse_m");
  // Spread 1 % of the logarithm: 9.925 * 0.01 * sqrt(4/3) = 0.1146.
  const auto band = band_of(metric, {5, 5, 5});
  ASSERT_TRUE(band);
  EXPECT_NEAR(band->high, 5 * std::exp(0.1146), 1e-3);
  EXPECT_TRUE(band->contains(5.1));
  EXPECT_FALSE(band->contains(6));
}

TEST(HistoryTest, NumbersInNamesCount) {
  EXPECT_TRUE(in_natural_order("run-9", "run-10"));
  EXPECT_FALSE(in_natural_order("run-10", "run-9"));
  EXPECT_TRUE(in_natural_order("v1.9", "v1.10"));
  EXPECT_TRUE(in_natural_order("2026-01-09", "2026-01-10"));
  EXPECT_FALSE(in_natural_order("a", "a"));
  EXPECT_TRUE(in_natural_order("a", "a1"));
}

class HistoryFolderTest : public testing::Test {
 protected:
  void add(const std::string& version, int seed, double ate) {
    std::filesystem::create_directories(folder_ / (version + "/s/seed-" + std::to_string(seed)));
    folder_.write(version + "/s/seed-" + std::to_string(seed) + "/metrics.json",
                  "{\"scenario\": \"s\", \"seed\": " + std::to_string(seed) +
                      ", \"frames\": 9, \"ate_rmse_m\": " + std::to_string(ate) + "}");
  }
  nlohmann::ordered_json ate() const {
    const auto history = history_json(folder_.path());
    for (const auto& series : history["series"]) {
      if (series["metric"] == "ate_rmse_m") return series;
    }
    return {};
  }
  test::TestFolder folder_;
};

TEST_F(HistoryFolderTest, ALargerErrorIsAnAlarm) {
  for (int version = 8; version <= 10; ++version) {
    for (int seed = 1; seed <= 3; ++seed) {
      add("v" + std::to_string(version), seed, 0.001 * seed);
    }
  }
  add("v11", 1, 0.004);
  const auto series = ate();
  // Medians of seeds 1 to 3 are 2 mm; one seed of 4 mm is beyond 2 mm * exp(0.1146).
  EXPECT_EQ(series["values"], (nlohmann::ordered_json{2.0, 2.0, 2.0, 4.0}));
  EXPECT_EQ(series["change"], "worse");
  EXPECT_EQ(history_json(folder_.path())["versions"],
            (nlohmann::ordered_json{"v8", "v9", "v10", "v11"}));
}

TEST_F(HistoryFolderTest, TooFewVersionsAreNoAlarm) {
  add("v1", 1, 0.001);
  add("v2", 1, 0.005);
  EXPECT_EQ(ate()["change"], "unknown");
}

TEST_F(HistoryFolderTest, FoldersWithoutRunsAreErrors) {
  EXPECT_THAT(test::error_of([&] { history_json(folder_.path()); }),
              HasSubstr("contains no folder"));
  EXPECT_THAT(test::error_of([&] { history_json(folder_ / "absent"); }),
              HasSubstr("expected a folder of versions"));
  std::filesystem::create_directories(folder_ / "v1");
  EXPECT_THAT(test::error_of([&] { history_json(folder_.path()); }), HasSubstr("contains no run"));
}

}  // namespace
}  // namespace vinebench::harness
