// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

namespace vinebench::harness {

/// CPU and wall time of a piece of work. For benchmarks only: no result of a run depends on it.
struct Timing {
  double cpu_ms = 0;  ///< of all threads of the process
  double wall_ms = 0;
};

Timing measure(const std::function<void()>& work);

/// The upper of the middle two if the count is even. Requires at least one value.
double median(std::vector<double> values);

/// Of each quantity separately.
Timing median(const std::vector<Timing>& timings);

/// Two decimals, for reports.
double rounded(double value);

/// Peak memory of this process so far, or since reset_peak_memory(), MiB.
double peak_memory_mib();

/// Returns free memory to the system and resets the peak to the current value. No effect if the
/// system does not support it.
void reset_peak_memory();

}  // namespace vinebench::harness
