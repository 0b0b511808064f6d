// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "scenarios/run_scenario.h"

#include <cstdlib>

namespace vinebench {
namespace {

const char* non_empty(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

}  // namespace

std::filesystem::path default_cache() {
  if (const char* folder = non_empty("VINEBENCH_CACHE")) return folder;
  if (const char* folder = non_empty("XDG_CACHE_HOME")) {
    return std::filesystem::path(folder) / "vinebench";
  }
  if (const char* home = non_empty("HOME")) {
    return std::filesystem::path(home) / ".cache" / "vinebench";
  }
  return std::filesystem::temp_directory_path() / "vinebench-cache";
}

RunOutcome run_scenario(const ScenarioConfig& scenario, int threads, const RunOptions& options) {
  WorkerPool pool(threads);
  const auto source = make_simulation(
      scenario.simulation, static_cast<std::uint64_t>(scenario.seed), default_cache(), pool);
  const auto slam =
      make_slam(scenario.slam, source->rig(), registered_tags(scenario.simulation.world), pool);
  return run_lockstep_and_judge(scenario, *source, *slam, options);
}

}  // namespace vinebench
