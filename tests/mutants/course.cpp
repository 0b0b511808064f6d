// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/mutants/course.h"

#include <algorithm>

#include "core/util/error.h"
#include "harness/experiment/known_discrepancies.h"
#include "harness/judge/results.h"
#include "harness/run/lockstep.h"
#include "sim/world/world_layout.h"
#include "slam/slam.h"

namespace vinebench::mutants {

Course::Course(const std::filesystem::path& scenario, int threads)
    : file_(scenario),
      scenario_(harness::load_scenario(scenario)),
      machine_(harness::machine_of_environment()),
      pool_(threads) {
  frames_ = std::make_unique<KeptFrames>(*simulate(scenario_));
}

std::unique_ptr<SimulatedSource> Course::simulate(const harness::ScenarioConfig& scenario) {
  return sim::make_simulation(scenario.simulation, static_cast<std::uint64_t>(scenario.seed),
                              machine_.plant_cache, pool_);
}

Outcome Course::run(const Mutant& mutant) {
  if (mutant.settings.empty()) {
    frames_->rewind();
    return judge(*frames_, scenario_, mutant);
  }
  const harness::ScenarioConfig changed = harness::load_scenario(file_, mutant.settings);
  return judge(*simulate(changed), changed, mutant);
}

Outcome Course::judge(FrameSource& source, const harness::ScenarioConfig& simulated,
                      const Mutant& mutant) {
  Told told{source.rig(), registered_tags(scenario_), scenario_.slam};
  if (mutant.tell) mutant.tell(told);
  const harness::Trial trial = harness::trial_of(scenario_);
  Outcome outcome;
  outcome.discrepancies =
      harness::known_discrepancies(simulated.simulation, static_cast<std::uint64_t>(simulated.seed),
                                   load_rig(simulated.simulation.rover.rig),
                                   {told.rig, told.tags, told.config.dead_reckoning.wheels});
  std::erase_if(outcome.discrepancies, [&](const harness::Discrepancy& d) {
    return std::ranges::any_of(trial.discrepancies, [&d](const harness::Discrepancy& own) {
      return own.of == d.of && own.what == d.what && own.size == d.size;
    });
  });
  std::unique_ptr<slam::MappingSystem> honest;
  try {
    honest = slam::make_slam(told.config, told.rig, told.tags, pool_);
  } catch (const Error&) {
    outcome.failed.push_back({"refused by the estimator", "", ""});
    return outcome;
  }
  drive(source, *honest, mutant, trial, outcome);
  return outcome;
}

void Course::drive(FrameSource& source, SlamSystem& honest, const Mutant& mutant,
                   const harness::Trial& trial, Outcome& outcome) const {
  SlamSystem* system = &honest;
  std::optional<FaultySlam> faulty;
  if (mutant.fault) {
    system = &faulty.emplace(honest, *mutant.fault, source.size(), source.rig().rate_hz);
  }
  harness::RunRecorder recorder(source.rig(), sim::world_tags(scenario_.simulation.world));
  harness::run_lockstep(source, *system, {&recorder});
  const harness::RunRecord& record = recorder.record();
  const harness::RunResults results = harness::measure(record, trial);
  for (harness::Check& check : harness::check_trial(trial, results)) {
    if (!check.holds()) outcome.failed.push_back(std::move(check));
  }
  outcome.estimate = record.summary.trajectory;
  if (results.consistency) outcome.nees = results.consistency->nees_mean;
  outcome.patterns = harness::error_patterns(record, results);
  outcome.segments = harness::diagnose(record, results, trial);
}

}  // namespace vinebench::mutants
