// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/config/override.h"
#include "harness/benchmarks/slam_benchmark.h"
#include "harness/machine.h"

namespace vinebench::tools {

// What a build with the simulation does and one without cannot: with_simulation.cpp and
// without_simulation.cpp, of which a build has one.

/// Names and versions of the libraries that simulate and draw; none without the simulation.
std::vector<std::pair<std::string, std::string>> simulation_versions(
    const harness::Machine& machine);

struct SimulatedFrames {
  std::filesystem::path scenario;
  std::vector<Override> overrides;
  int frames = 150;  ///< at most
  harness::Machine machine;
  /// If given, the scenario is untrusted: check_untrusted() with these folders.
  std::optional<std::vector<std::filesystem::path>> data_folders{};
};

/// Fills the benchmark with the first frames of a scenario, made with its number of threads. Throws
/// Error for a faulty scenario, and in a build without the simulation.
void simulate_frames(const SimulatedFrames& wanted, harness::SlamBenchmark& benchmark);

}  // namespace vinebench::tools
