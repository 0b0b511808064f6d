// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/search/honest_runs.h"

#include <memory>

#include "core/util/error.h"
#include "harness/judge/run_report.h"
#include "harness/report/report_json.h"
#include "harness/run/lockstep.h"
#include "harness/sets/run_inputs.h"
#include "sim/simulation.h"
#include "slam/slam.h"

namespace vinebench::search_faults {

using namespace harness;

HonestRuns::HonestRuns(int threads) : machine_(machine_of_environment()), pool_(threads) {}

SetOutcome HonestRuns::make(const std::vector<PlannedRun>& plan, const PlantedFault& fault) {
  SetOutcome outcome;
  for (const PlannedRun& planned : plan) {
    SetRun& run = outcome.runs.emplace_back();
    run.scenario = planned.title;
    run.seed = planned.seed;
    run.folder = planned.folder;
    const ScenarioConfig scenario = planned.scenario();
    const bool is_faulty = planned.folder.parent_path().parent_path().filename() == "system";
    try {
      const RunRecord& honest = record_of(scenario);
      const RunReport report =
          judge(is_faulty ? with_fault(honest, fault) : honest, trial_of(scenario));
      run.result = stored_run(to_json(report));
    } catch (const Error& error) {
      run.error = error.what();
    }
  }
  return outcome;
}

const RunRecord& HonestRuns::record_of(const ScenarioConfig& scenario) {
  const std::string key = fingerprint_of_inputs(scenario);
  const auto known = records_.find(key);
  if (known != records_.end()) return known->second;
  const std::unique_ptr<FrameSource> source = sim::make_simulation(
      scenario.simulation, static_cast<std::uint64_t>(scenario.seed), machine_.plant_cache, pool_);
  const auto system =
      slam::make_slam(scenario.slam, source->rig(), registered_tags(scenario), pool_);
  RunRecorder recorder(source->rig(), trial_of(scenario).site.tags);
  run_lockstep(*source, *system, {&recorder});
  return records_.emplace(key, recorder.record()).first->second;
}

}  // namespace vinebench::search_faults
