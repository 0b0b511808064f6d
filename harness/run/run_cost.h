// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/util/stage_timer.h"

namespace vinebench::harness {

/// Times of one stage, ms per call.
struct StageTiming {
  std::string stage;
  double mean = 0;
  double median = 0;
  double p95 = 0;
};

/// What a run took. Reported beside its results, never part of them.
struct RunCost {
  double wall_seconds = 0;
  double cpu_seconds = 0;
  double real_time_factor = 0;      ///< simulated or recorded time by wall-clock time
  double peak_rss_mib = 0;          ///< of the process
  std::vector<StageTiming> stages;  ///< those that were called, by name
};

/// Of the stages that have samples.
std::vector<StageTiming> stage_timings(const StageTimes& times);

/// Peak memory of this process, MiB.
double peak_rss_mib();

/// CPU time of this process' threads and of child processes that have been waited for, s, since the
/// program started (the process may have been a shell before).
double cpu_seconds();

}  // namespace vinebench::harness
