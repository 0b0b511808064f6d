// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/sets/run_set.h"

namespace vinebench::test {

/// A run of the scenario "row" with this ATE, m, with the first pose aligned, and one check.
inline harness::SetRun set_run(std::int64_t seed, double ate, bool ok = true) {
  harness::RunReport report;
  report.scenario = "row";
  report.seed = seed;
  report.results.corrected.emplace();
  report.results.corrected->origin.rmse = ate;
  report.checks = {{"losses", ok ? "0" : "2", "<= 0", ok}};
  report.cost.wall_seconds = 1.5;
  return {.scenario = "row",
          .seed = seed,
          .folder = "out/row/seed-" + std::to_string(seed),
          .result = harness::stored_run(harness::to_json(report))};
}

/// One that crashed.
inline harness::SetRun crashed_run(std::int64_t seed) {
  return {.scenario = "row",
          .seed = seed,
          .folder = "out/row/seed-" + std::to_string(seed),
          .error = "ended by signal 9"};
}

}  // namespace vinebench::test
