// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/guard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/report/report_json.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

/// A run for each value, which `set` enters.
template <class Set>
std::vector<StoredRun> runs_with(const std::vector<double>& values, Set set) {
  std::vector<StoredRun> runs;
  for (const double value : values) {
    RunReport report;
    report.results.coverage = 1;
    set(report.results, value);
    runs.push_back(*stored_run(to_json(report)));
  }
  return runs;
}

void set_ate(RunResults& results, double value) {
  results.corrected.emplace().ate.rmse = value;
}

const GuardBound* find(const std::vector<GuardBound>& bounds, const std::string& key) {
  for (const GuardBound& bound : bounds) {
    if (key == bound.bound->key) return &bound;
  }
  return nullptr;
}

// Median 3 mm, worst 5 mm: 3 + 2 (5 - 3) = 7 mm.
TEST(GuardTest, AnErrorIsAllowedTwiceItsSpread) {
  const auto bounds = derive_guard(runs_with({0.001, 0.002, 0.003, 0.004, 0.005}, set_ate));
  const GuardBound* ate = find(bounds, "ate_rmse_max");
  ASSERT_NE(ate, nullptr);
  EXPECT_DOUBLE_EQ(ate->median, 0.003);
  EXPECT_DOUBLE_EQ(ate->worst, 0.005);
  EXPECT_DOUBLE_EQ(ate->value, 0.007);
}

// Equal runs leave a quarter: 1.25 * 3.333 mm = 4.166 mm, up to three digits.
TEST(GuardTest, EqualRunsLeaveAMargin) {
  const auto bounds = derive_guard(runs_with(std::vector<double>(5, 0.003333), set_ate));
  EXPECT_DOUBLE_EQ(find(bounds, "ate_rmse_max")->value, 0.00417);
}

// Median 4, smallest 2, largest 8: 4 (2 / 4)^2 = 1 and 4 (8 / 4)^2 = 16.
TEST(GuardTest, ARatioIsAllowedTwiceItsSpreadBothWays) {
  const auto bounds = derive_guard(runs_with({2, 4, 4, 4, 8}, [](RunResults& results, double nees) {
    results.consistency = Consistency{.frames = 9, .nees_mean = nees};
  }));
  EXPECT_DOUBLE_EQ(find(bounds, "nees_mean_min")->value, 1);
  EXPECT_DOUBLE_EQ(find(bounds, "nees_mean_max")->value, 16);
}

// Overconfident: 400 (100 / 400)^2 = 25 would fail covariances that become consistent.
TEST(GuardTest, ConsistentCovariancesFailNoGuard) {
  const auto bounds =
      derive_guard(runs_with({100, 400, 400, 400, 400}, [](RunResults& results, double nees) {
        results.consistency = Consistency{.frames = 9, .nees_mean = nees};
      }));
  EXPECT_DOUBLE_EQ(find(bounds, "nees_mean_min")->value, 6);
}

// Coverages of 1 and once 0.9: 1 - 2 * 0.1 = 0.8. Losses: the most of any run.
TEST(GuardTest, SharesAndCountsHaveNoMargin) {
  const auto bounds =
      derive_guard(runs_with({1, 1, 1, 1, 0.9}, [](RunResults& results, double coverage) {
        results.coverage = coverage;
        results.losses = coverage < 1 ? 1 : 0;
      }));
  EXPECT_DOUBLE_EQ(find(bounds, "coverage_min")->value, 0.8);
  EXPECT_DOUBLE_EQ(find(bounds, "losses_max")->value, 1);
  const auto all = derive_guard(runs_with(std::vector<double>(5, 0), [](RunResults&, double) {}));
  EXPECT_DOUBLE_EQ(find(all, "coverage_min")->value, 1);
}

TEST(GuardTest, AMetricOfSomeRunsOnlyHasNoBound) {
  std::vector<StoredRun> runs = runs_with({1, 2, 3, 4}, set_ate);
  runs.push_back(runs_with({0}, [](RunResults&, double) {}).front());
  const auto bounds = derive_guard(runs);
  EXPECT_EQ(find(bounds, "ate_rmse_max"), nullptr);
  EXPECT_NE(find(bounds, "coverage_min"), nullptr);
}

TEST(GuardTest, FewSeedsAreAnError) {
  EXPECT_THROW(derive_guard(runs_with({1, 2, 3, 4}, set_ate)), Error);
}

TEST(GuardTest, TheBlockHasTheMeasurement) {
  const auto bounds = derive_guard(runs_with({0.001, 0.002, 0.003, 0.004, 0.005}, set_ate));
  const std::string block = format_guard(bounds, "row", "1..5");
  EXPECT_TRUE(block.starts_with("guard:\n  # By `vinebench guard row --seeds 1..5 --write`"));
  EXPECT_THAT(block, HasSubstr("\n  seeds: 1..5\n"));
  EXPECT_THAT(block, HasSubstr("  ate_rmse_max: 0.007                   # median 0.003, worst "
                               "0.005, spread 0.002\n"));
}

TEST(GuardTest, TheBlockTakesTheOldOnesPlace) {
  const std::string rest = "# about the goal\ngoal: {losses_max: 0}\n";
  EXPECT_EQ(with_guard("name: a\nguard:\n  # old\n  losses_max: 9\n" + rest, "guard:\n  x: 1\n"),
            "name: a\nguard:\n  x: 1\n" + rest);
  EXPECT_EQ(with_guard("name: a\n", "guard:\n  x: 1\n"), "name: a\n\nguard:\n  x: 1\n");
  EXPECT_EQ(with_guard("name: a\nguard: {losses_max: 9}\n", "guard:\n  x: 1\n"),
            "name: a\nguard:\n  x: 1\n");
}

/// Why `check_guard_place` refuses; the folder has nothing but the file afterwards.
std::string refusal(const test::TestFolder& folder, const std::filesystem::path& file) {
  const auto files = [&] {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      ++count;
    }
    return count;
  };
  const std::size_t before = files();
  std::string why = test::error_of([&] { check_guard_place(file); });
  EXPECT_EQ(files(), before);
  return why;
}

TEST(GuardTest, APlaceForItIsAScenarioThatCanBeWritten) {
  const test::TestFolder folder;
  const std::string base = std::string(VINEBENCH_SOURCE_DIR) + "/scenarios/quick-loop.yaml";
  const auto good = folder.write("good.yaml", "base: " + base + "\nname: good\n");
  EXPECT_EQ(refusal(folder, good), "");
  EXPECT_EQ(read_file(good), "base: " + base + "\nname: good\n");
  // A mapping in braces is complete: nothing can follow it.
  const auto flow = folder.write("flow.yaml", "{base: " + base + ", name: flow}\n");
  EXPECT_THAT(refusal(folder, flow), HasSubstr("flow.yaml: would be no scenario with a block"));
  const auto quoted = folder.write("q.yaml", "base: " + base + "\n'guard': {losses_max: 0}\n");
  EXPECT_THAT(refusal(folder, quoted), HasSubstr("q.yaml: would be no scenario with a block"));
  std::filesystem::create_symlink(good, folder / "link.yaml");
  EXPECT_THAT(refusal(folder, folder / "link.yaml"), HasSubstr("link.yaml: is a link"));
  EXPECT_THAT(refusal(folder, folder / "none.yaml"), HasSubstr("none.yaml: cannot be read"));
}

// Permissions do not bind root, but nothing can be made in /proc.
TEST(GuardTest, AFolderThatTakesNoFileIsNoPlaceForIt) {
  const test::TestFolder folder;
  EXPECT_THAT(refusal(folder, "/proc/self/status"), HasSubstr("/proc/self/status"));
}

}  // namespace
}  // namespace vinebench::harness
