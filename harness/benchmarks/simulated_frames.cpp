// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/simulated_frames.h"

#include "sim/world/world_layout.h"

namespace vinebench::harness {

void load_simulated_frames(const ScenarioConfig& scenario, const Machine& machine, int frames,
                           SlamBenchmark& benchmark) {
  WorkerPool pool(benchmark.threads);
  const auto source = sim::make_simulation(
      scenario.simulation, static_cast<std::uint64_t>(scenario.seed), machine.plant_cache, pool);
  benchmark.name = scenario.name;
  benchmark.rig = source->rig();
  benchmark.tags = registered_tags(scenario);
  benchmark.slam = scenario.slam;
  benchmark.frames = preload(*source, frames);
}

}  // namespace vinebench::harness
