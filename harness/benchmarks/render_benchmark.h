// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "harness/benchmarks/render_case.h"

namespace vinebench::harness {

/// Measures in separate processes, so that memory is the world's. Returns medians over the frames:
/// for each camera `cpu_ms` (all threads of the process) and `wall_ms` of an image with one thread;
/// for whole frames `frame_wall_ms` with 1 and with `threads` threads and their ratio `scaling`;
/// and `memory_mib` of the process with `threads` threads. Throws Error.
nlohmann::ordered_json measure_rendering(const RenderBenchmark& benchmark);

}  // namespace vinebench::harness
