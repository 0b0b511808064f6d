// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "scenarios/run_scenario.h"

#include <cstdlib>

#include "scenarios/dataset_folder.h"
#include "scenarios/dataset_writer.h"
#include "slam/base/error.h"

namespace vinebench {
namespace {

const char* non_empty(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

/// Better before a long run than after it.
void expect_folder(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    fail("{}: there is no folder {}", file.string(), folder.string());
  }
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

RunOutcome run_mapping_system(const ScenarioConfig& scenario, FrameSource& source,
                              MappingSystem& slam, const RunOptions& options) {
  expect_folder(options.maps.save);
  expect_folder(options.maps.cloud);
  if (!options.maps.load.empty()) slam.load_map(options.maps.load);
  const RunOutcome outcome = run_lockstep_and_judge(scenario, source, slam, options);
  if (!options.maps.save.empty()) slam.save_map(options.maps.save);
  if (!options.maps.cloud.empty()) slam.save_cloud(options.maps.cloud);
  return outcome;
}

RunOutcome run_scenario(const ScenarioConfig& scenario, int threads, const RunOptions& options,
                        const std::optional<RunRecording>& recording) {
  expect_folder(options.maps.save);  // before the vineyard is grown
  expect_folder(options.maps.cloud);
  if (recording) claim_folder(recording->folder);
  WorkerPool pool(threads);
  const CapturePlan plan =
      recording ? plan_of(recording->options, load_rig(scenario.simulation.rover.rig))
                : CapturePlan();
  const auto source = make_simulation(
      scenario.simulation, static_cast<std::uint64_t>(scenario.seed), default_cache(), pool, plan);
  const auto slam =
      make_slam(scenario.slam, source->rig(), registered_tags(scenario.simulation.world), pool);
  if (!recording) return run_mapping_system(scenario, *source, *slam, options);
  DatasetWriter writer(recording->folder, scenario, *source, recording->options, source->size());
  RunOptions with_writer = options;
  with_writer.sinks.push_back(&writer);
  return run_mapping_system(scenario, *source, *slam, with_writer);
}

}  // namespace vinebench
