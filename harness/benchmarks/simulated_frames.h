// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/benchmarks/slam_benchmark.h"
#include "harness/experiment/scenario.h"
#include "harness/machine.h"

namespace vinebench::harness {

/// Fills a benchmark with the first frames of a scenario, at most so many, and with its rig, tags
/// and settings; its threads draw.
void load_simulated_frames(const ScenarioConfig& scenario, const Machine& machine, int frames,
                           SlamBenchmark& benchmark);

}  // namespace vinebench::harness
