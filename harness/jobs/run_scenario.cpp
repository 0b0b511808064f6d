// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/run_scenario.h"

#include "core/util/error.h"
#include "harness/datasets/dataset_writer.h"
#include "harness/datasets/files/dataset_folder.h"
#include "harness/datasets/formats.h"
#include "harness/jobs/simulation_versions.h"
#include "harness/report/run_folder.h"
#include "harness/run/prefetch.h"
#include "harness/systems/failed_system.h"
#include "harness/systems/other_system.h"
#include "harness/systems/process_group.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

std::unique_ptr<SlamSystem> made_system(const SystemMaker& make, const SystemSetup& setup) {
  try {
    return make(setup);
  } catch (const SystemFailure& failure) {
    return std::make_unique<FailedSystem>(failure);
  }
}

RunOutcome run_made_system(const SystemMaker& make, const ScenarioConfig& scenario,
                           FrameSource& source, int threads, const RunOptions& options) {
  const auto slam = made_system(make, {source.rig(), registered_tags(scenario),
                                       scenario.slam.dead_reckoning.wheels, threads});
  Trial trial = trial_of(scenario);
  trial.guard = trial.now = {};
  return run_lockstep_and_judge(trial, source, *slam, options);
}

/// With a SLAM system that is not ours.
RunOutcome run_other_system(const ScenarioConfig& scenario, const RecordingNotes& notes,
                            FrameSource& source, const Machine& machine, int threads,
                            const RunOptions& options) {
  std::optional<TemporaryFolder> temporary;
  if (options.folder.empty()) temporary.emplace();
  const auto slam = make_other_system(
      scenario.slam, source.rig(), notes, threads,
      {machine.plugin_host, temporary ? temporary->path() : options.folder, options.stopped});
  return run_lockstep_and_judge(trial_of(scenario), source, *slam, options);
}

RunOutcome drive(const ScenarioConfig& scenario, const Machine& machine, int threads,
                 const RunOptions& options, const std::optional<RunRecording>& recording,
                 const SystemMaker& make = {}) {
  check_map_folders(options.maps);  // before the vineyard is generated
  const bool ours = !make && scenario.slam.is_core();
  if (!ours) expect_no_maps(options.maps);
  if (!make && scenario.slam.external) check_executable(scenario.slam.external->program);
  std::optional<FolderLock> lock;
  if (recording) {
    lock.emplace(lock_recording(recording->folder));
    claim_folder(recording->folder);
  }
  // Separate pools, because rendering and estimation run concurrently.
  WorkerPool drawing(threads);
  WorkerPool estimating(threads);
  CapturePlan plan;
  if (recording) {
    plan = plan_of(recording->options, load_rig(scenario.simulation.rover.rig));
    plan.cameras.clear();  // the SLAM system gets all images
  }
  const auto simulation =
      sim::make_simulation(scenario.simulation, static_cast<std::uint64_t>(scenario.seed),
                           machine.plant_cache, drawing, plan);
  std::optional<Prefetch> ahead;
  if (threads > 1 && scenario.simulation.route.steering == sim::Steering::kTruth) {
    ahead.emplace(*simulation);
  }
  FrameSource& source = ahead ? static_cast<FrameSource&>(*ahead) : *simulation;
  RunOptions with_writer = options;
  with_writer.libraries = drawing_libraries(scenario.simulation.renderer);
  std::optional<DatasetWriter> writer;
  if (recording) {
    writer.emplace(recording->folder, notes_of(scenario), *simulation, recording->options,
                   source.size());
    with_writer.sinks.push_back(&*writer);
  }
  if (make) return run_made_system(make, scenario, source, threads, with_writer);
  if (!ours) {
    RecordingNotes notes = notes_of(scenario);
    notes.first_reading = simulation->first_reading();
    return run_other_system(scenario, notes, source, machine, threads, with_writer);
  }
  const auto slam =
      slam::make_slam(scenario.slam, source.rig(), registered_tags(scenario), estimating);
  return run_mapping_system(trial_of(scenario), source, *slam, with_writer);
}

/// The earlier visit of a scenario, which leaves its map in a file.
RunOutcome visit_earlier(const ScenarioConfig& scenario, const Machine& machine, int threads,
                         const RunOptions& options, const std::filesystem::path& map) {
  ScenarioConfig earlier = scenario;
  earlier.name += " (earlier visit)";  // compared runs have names of their own
  earlier.earlier_visit.reset();
  earlier.simulation = simulation_of(*scenario.earlier_visit, scenario.simulation);
  earlier.expectations = earlier.goal = earlier.now = {};
  earlier.guard.reset();
  RunOptions run;
  run.maps.save = map;
  run.progress = options.progress;
  run.terminal = options.terminal;
  run.title = earlier.name;
  run.stopped = options.stopped;
  std::optional<FolderLock> lock;
  if (!options.folder.empty()) {
    run.folder = options.folder / "earlier-visit";
    lock.emplace(prepare_scenario_folder(run.folder, earlier));
  }
  return drive(earlier, machine, threads, run, std::nullopt);
}

}  // namespace

FolderLock prepare_scenario_folder(const std::filesystem::path& folder,
                                   const ScenarioConfig& scenario) {
  return prepare_run_folder(folder, "scenario.resolved.yaml", resolved_settings(scenario));
}

RunOutcome run_scenario(const ScenarioConfig& scenario, const Machine& machine, int threads,
                        const RunOptions& options, const std::optional<RunRecording>& recording) {
  if (!scenario.earlier_visit) return drive(scenario, machine, threads, options, recording);
  if (!options.maps.load.empty()) {
    fail("--load-map: {} begins with the map of its own earlier_visit", scenario.name);
  }
  const TemporaryFolder kept;
  RunOptions with_map = options;
  with_map.maps.load = kept.path() / "map";
  RunOutcome earlier = visit_earlier(scenario, machine, threads, options, with_map.maps.load);
  if (earlier.interrupted) return earlier;
  return drive(scenario, machine, threads, with_map, recording);
}

RunOutcome run_scenario_with(const SystemMaker& make, const ScenarioConfig& scenario,
                             const Machine& machine, int threads, const RunOptions& options) {
  if (scenario.earlier_visit) {
    fail("{}: earlier_visit: requires the built-in SLAM core, whose map is kept", scenario.name);
  }
  return drive(scenario, machine, threads, options, std::nullopt, make);
}

}  // namespace vinebench::harness
