// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/util/error.h"
#include "harness/sweep/sweep_plan.h"
#include "tests/support/fake_scenario.h"

namespace vinebench::test {

/// fake_scenario() under any name. The override "speed" is its duration, "bad" is refused.
inline harness::ScenarioConfig load_fake(const std::string& name,
                                         const std::vector<Override>& overrides) {
  harness::ScenarioConfig scenario = fake_scenario();
  scenario.name = name.substr(0, name.find('.'));
  for (const auto& [key, value] : overrides) {
    if (key == "bad") fail("{}: bad: unknown key", name);
    scenario.simulation.duration = std::stod(value);
  }
  return scenario;
}

/// Two scenarios, two points and three seeds: twelve tasks. A task of "row" costs 1 s, of "loop" 3.
inline harness::SweepPlan fake_plan(int repeats = 1) {
  harness::SweepSpec spec;
  spec.scenarios = {"row", "loop"};
  spec.seeds = "1..3";
  spec.repeats = repeats;
  spec.grid = {{"speed", {"1", "2"}}};
  return harness::make_plan(spec, load_fake, [](const harness::ScenarioConfig& scenario) {
    return scenario.name == "row" ? 1.0 : 3.0;
  });
}

}  // namespace vinebench::test
