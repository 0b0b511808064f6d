// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/run_cost.h"

#include <sys/resource.h>

#include <numeric>

#include "core/util/percentile.h"

namespace vinebench::harness {
namespace {

double cpu_of_process() {
  double seconds = 0;
  for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime}) {
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
  }
  return seconds;
}

/// A process that a shell became by `exec` inherits the shell's time and that of its children.
const double kCpuAtStart = cpu_of_process();

}  // namespace

std::vector<StageTiming> stage_timings(const StageTimes& times) {
  std::vector<StageTiming> timings;
  for (const auto& [stage, samples] : times.samples()) {
    if (samples.empty()) continue;
    const double sum = std::accumulate(samples.begin(), samples.end(), 0.0);
    timings.push_back({stage, sum / static_cast<double>(samples.size()), percentile(samples, 0.5),
                       percentile(samples, 0.95)});
  }
  return timings;
}

double peak_rss_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // KiB on Linux
}

double cpu_seconds() {
  return cpu_of_process() - kCpuAtStart;
}

}  // namespace vinebench::harness
