// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace vinebench::harness {

/// What a piece of work took. For benchmarks only: no result of a run depends on it.
struct Timing {
  double cpu_ms = 0;  ///< of all threads of the process
  double wall_ms = 0;
};

Timing measure(const std::function<void()>& work);

/// The upper one of the middle two where the count is even. Expects at least one value.
double median(std::vector<double> values);

/// Of each figure by itself.
Timing median(const std::vector<Timing>& timings);

/// Two decimals, for reports.
double rounded(double value);

/// The most memory that this process has held so far or since reset_peak_memory(), MiB.
double peak_memory_mib();

/// Gives back what is free, and makes what is held then the most that was held. Without effect
/// where the system has no such thing.
void reset_peak_memory();

}  // namespace vinebench::harness
