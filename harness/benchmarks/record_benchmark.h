// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "harness/experiment/scenario.h"

namespace vinebench::harness {

/// Settings of `vinebench bench record`: the cost of recording beside the simulation.
struct RecordBenchmark {
  ScenarioConfig scenario;
  std::int64_t frames = 60;  ///< the first ones of the run
  int rounds = 1;            ///< each kind is measured so often, in turn; the median counts
  int threads = 2;           ///< for rendering, and as many for encoding
  CacheFolder plant_cache;
  std::filesystem::path folder;  ///< for recordings, which are removed afterwards
};

/// Wall and CPU time of the frames (`wall_s`, `cpu_s` of all threads), the ratio of wall time to
/// that without recording, `megabytes` and `images_per_hour`, in `rows`: simulated alone (`record`)
/// and with the SLAM core (`run`), each without recording, with every camera's colour images as PNG
/// (`rgb`) and with every kind of label in addition (`labels`); `record training` is the stereo
/// pairs' images with depth, semantic, instances and COCO. Without the generation of the vineyard.
nlohmann::ordered_json measure_recording(const RecordBenchmark& benchmark);

/// The result as a human-readable table.
std::string record_table(const nlohmann::ordered_json& result);

}  // namespace vinebench::harness
