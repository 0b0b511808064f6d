// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "scenarios/scenario.h"

namespace vinebench {

/// What `vinebench bench record` measures: what recording costs beside the simulation.
struct RecordBenchmark {
  ScenarioConfig scenario;
  std::int64_t frames = 60;      ///< the first ones of the run
  int threads = 2;               ///< that draw, and as many that encode
  std::filesystem::path folder;  ///< for recordings, which are removed again
};

/// Wall time of the frames, simulated alone (`base_wall_s`) and recorded: `rgb`, every camera's
/// pictures in colour as PNG; `all`, every format; `training`, the stereo pairs' pictures with
/// depth, semantic, instances and COCO. For each `wall_s`, `cpu_s` (all threads), `ratio` to the
/// base, `megabytes` and `images_per_hour`. Growing the vineyard is in no figure.
nlohmann::ordered_json measure_recording(const RecordBenchmark& benchmark);

/// The result as a table for people.
std::string record_table(const nlohmann::ordered_json& result);

}  // namespace vinebench
