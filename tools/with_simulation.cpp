// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>

#include "core/util/error.h"
#include "harness/benchmarks/simulated_frames.h"
#include "harness/jobs/simulation_versions.h"
#include "tools/gl_variable.h"
#include "tools/simulation.h"

namespace vinebench::tools {

std::vector<std::pair<std::string, std::string>> simulation_versions() {
  return harness::simulation_versions(gl_variable());
}

void simulate_frames(const SimulatedFrames& wanted, harness::SlamBenchmark& benchmark) {
  constexpr const char* kDefaultScenario = "scenarios/quick-loop.yaml";
  const bool named = !wanted.scenario.empty();
  const std::filesystem::path file = named ? wanted.scenario : kDefaultScenario;
  if (!named && !std::filesystem::exists(file)) {
    fail(
        "bench slam: no {} here; run it in the project's folder, or name a DATASET or a --scenario",
        file.string());
  }
  harness::ScenarioConfig scenario = harness::load_scenario(file, wanted.overrides);
  sim::choose_backend(scenario.simulation.renderer, gl_variable());
  fmt::print(stderr, "simulating at most {} frames of {} …\n", wanted.frames, scenario.name);
  harness::load_simulated_frames(scenario, wanted.frames, benchmark);
}

}  // namespace vinebench::tools
