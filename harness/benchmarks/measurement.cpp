// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/measurement.h"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

double wall_ms() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

double cpu_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace

Timing measure(const std::function<void()>& work) {
  const double cpu = cpu_ms();
  const double wall = wall_ms();
  work();
  return {cpu_ms() - cpu, wall_ms() - wall};
}

double median(std::vector<double> values) {
  if (values.empty()) fail("median: expected at least one value");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Timing median(const std::vector<Timing>& timings) {
  std::vector<double> cpu;
  std::vector<double> wall;
  for (const Timing& timing : timings) {
    cpu.push_back(timing.cpu_ms);
    wall.push_back(timing.wall_ms);
  }
  return {median(std::move(cpu)), median(std::move(wall))};
}

double rounded(double value) {
  return std::round(100 * value) / 100;
}

void reset_peak_memory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace vinebench::harness
