// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/comparison/repeats.h"
#include "harness/report/metric_table.h"
#include "harness/sets/run_set.h"

namespace vinebench::harness {

/// One scenario of a set over its seeds.
struct SeedsSummary {
  std::string scenario;
  std::vector<SetRun> runs{};
  std::vector<std::optional<double>>
      medians{};  ///< of shown_metrics(), over the seeds that have each; of a seed's repeats too
  std::vector<Check> checks{};              ///< expectations of the median
  std::vector<Check> repeat_checks{};       ///< repeats of the built-in system agree by hash
  std::optional<RepeatsSummary> repeats{};  ///< if seeds ran several times

  bool passed() const;
};

/// The scenarios of a set in their order. A run without an error counts as infinite in the median.
/// Of several repeats of a seed the median counts, once.
std::vector<SeedsSummary> summarise(const std::vector<PlannedRun>& plan, SetOutcome outcome);

/// What a table shows of a run: all, or what is the same to the byte wherever it is run.
enum class TableColumns { kAll, kOfEstimate };

/// "passed", "passed (goal open)", "FAILED", "ERROR" or "missing".
std::string verdict_of(const SetRun& run);

/// A Markdown table: one row for each run, one for the medians of each scenario.
std::string format_table(const std::vector<SeedsSummary>& scenarios,
                         TableColumns columns = TableColumns::kAll);

/// What repeats tell of the system; empty without any.
std::string format_repeats(const std::vector<SeedsSummary>& scenarios);

/// Failures, one paragraph for each run; empty if there are none.
std::string format_failures(const std::vector<SeedsSummary>& scenarios);

/// The same as data.
Json summary_json(const std::vector<SeedsSummary>& scenarios);

}  // namespace vinebench::harness
