// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "harness/search/search_runs.h"

namespace vinebench::test {

/// The error of a system, m, in a scenario with a seed; the scenario's goal allows 0.03.
using FakeError = std::function<double(const harness::ScenarioConfig&, std::int64_t seed)>;

inline constexpr double kGoodError = 0.01;  // m
inline constexpr double kBadError = 0.1;    // m

/// A search among speed (0.5 to 1.3 m/s), sun (50 to 4 degrees) and gap (until 2.5 to 4.5 s) in
/// tests/search/drive.yaml, whose runs are functions: nothing is simulated.
class FakeSearch {
 public:
  explicit FakeSearch(FakeError system, std::optional<FakeError> reference = std::nullopt)
      : system_(std::move(system)), reference_(std::move(reference)) {
    problem.load = [](const std::vector<Override>& overrides) {
      return harness::load_scenario(VINEBENCH_SOURCE_DIR "/tests/search/drive.yaml", overrides);
    };
    problem.space.difficulties = {{"speed", {{"route.speed", {0.5, 1.3}}}, {}},
                                  {"sun", {{"world.sun.elevation_deg", {50, 4}}}, {}},
                                  {"gap", {{"sensors.drops.bursts.0.until", {2.5, 4.5}}}, {}}};
    if (reference_) problem.reference = std::vector<Override>();
  }

  harness::SearchRuns runs(std::size_t budget = 1000) {
    return {problem, "runs", [this](const auto& plan) { return make(plan); }, budget};
  }

  harness::SearchProblem problem;
  int made = 0;

 private:
  harness::SetOutcome make(const std::vector<harness::PlannedRun>& plan) {
    harness::SetOutcome outcome;
    for (const harness::PlannedRun& planned : plan) {
      ++made;
      const bool is_system = planned.folder.parent_path().parent_path().filename() == "system";
      const double error = (is_system ? system_ : *reference_)(*planned.settings, planned.seed);
      harness::SetRun& run = outcome.runs.emplace_back();
      run.folder = planned.folder;
      run.seed = planned.seed;
      run.result.emplace();
      run.result->values = {{"/ate_origin_rmse_m", error},
                            {"/coverage", 1},
                            {"/losses", 0},
                            {"/worst_frame/error_m", error},
                            {"/loop_closures/wrong", 0}};
      run.result->checks = {{"ATE", std::to_string(error), "0.03", error <= 0.03}};
    }
    return outcome;
  }

  FakeError system_;
  std::optional<FakeError> reference_;
};

inline double speed_of(const harness::ScenarioConfig& scenario) {
  return scenario.simulation.route.speed;
}
inline double sun_of(const harness::ScenarioConfig& scenario) {
  return scenario.simulation.world.sun.elevation_deg;
}
inline double gap_of(const harness::ScenarioConfig& scenario) {
  return scenario.simulation.sensors.drops.bursts.at(0).until.value();
}

inline void tell_nobody(const std::string&) {}

}  // namespace vinebench::test
