// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstdio>

#include "harness/benchmarks/simulated_frames.h"
#include "harness/experiment/trust.h"
#include "harness/jobs/simulation_versions.h"
#include "tools/commands/simulation.h"

namespace vinebench::tools {

std::vector<std::pair<std::string, std::string>> simulation_versions(
    const harness::Machine& machine) {
  return harness::simulation_versions(machine.gl_platform);
}

void simulate_frames(const SimulatedFrames& wanted, harness::SlamBenchmark& benchmark) {
  harness::ScenarioConfig scenario = harness::load_scenario(wanted.scenario, wanted.overrides);
  if (wanted.data_folders) {
    harness::check_untrusted(scenario, wanted.scenario, {*wanted.data_folders});
  }
  sim::choose_backend(scenario.simulation.renderer, wanted.machine.gl_platform);
  fmt::print(stderr, "simulating at most {} frames of {} …\n", wanted.frames, scenario.name);
  harness::load_simulated_frames(scenario, wanted.machine, wanted.frames, benchmark);
}

}  // namespace vinebench::tools
