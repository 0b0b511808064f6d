// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/experiment/scenario.h"
#include "tests/support/fakes.h"

namespace vinebench::test {

/// The scenario of fake_trial().
inline harness::ScenarioConfig fake_scenario() {
  harness::ScenarioConfig scenario;
  scenario.name = "fake";
  sim::WorldConfig& world = scenario.simulation.world;
  world.rows = {{{-1, 1.5}, {1, 1.5}}};
  world.tags.push_back({});
  world.tags.back().id = 7;
  world.tags.back().position = {1.3, 0, 0.5};
  world.occluders.push_back({});
  world.occluders.back().position = {-1.4, 0};
  return scenario;
}

/// After the start the estimate is off sideways by the seed in centimetres.
inline harness::RunOutcome run_fake(const harness::ScenarioConfig& scenario, int,
                                    const harness::RunOptions& options) {
  const double offset = 0.01 * static_cast<double>(scenario.seed);
  FakeSource source;
  FakeSlam slam([&](Estimate& estimate) {
    if (estimate.stamp > 0) estimate.T_map_body->translation.z() += offset;
  });
  return run_lockstep_and_judge(trial_of(scenario), source, slam, options);
}

}  // namespace vinebench::test
