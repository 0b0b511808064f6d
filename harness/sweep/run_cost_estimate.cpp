// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sweep/run_cost_estimate.h"

#include <algorithm>
#include <vector>

#include "core/geometry/rig.h"
#include "core/util/percentile.h"
#include "harness/comparison/paired_runs.h"
#include "sim/rover/route.h"

namespace vinebench::harness {
namespace {

// Of the short scenarios of an aisle, on a processor of 2023.
constexpr double kStart = 8;             // s
constexpr double kPerMegapixel = 0.052;  // s

}  // namespace

double drive_duration(const ScenarioConfig& scenario) {
  const double route = to_seconds(sim::Route(scenario.simulation.route).duration());
  return std::min(scenario.simulation.duration.value_or(route), route);
}

double estimate_cost(const ScenarioConfig& scenario) {
  const sim::SimulationConfig& simulation = scenario.simulation;
  const Rig rig = load_rig(simulation.rover.rig);
  const double seconds = drive_duration(scenario);
  double megapixels = 0;
  for (const RigCamera& camera : rig.cameras) {
    megapixels += 1e-6 * camera.model.width * camera.model.height;
  }
  return kStart + kPerMegapixel * megapixels * rig.rate_hz * seconds;
}

std::map<std::string, double> measured_costs(const std::filesystem::path& folder) {
  std::map<std::string, std::vector<double>> taken;
  for (const SeedRuns& seed : find_runs(folder)) {
    for (const StoredRun& run : seed.repeats) {
      if (const auto seconds = run.value("/cpu_seconds")) taken[run.scenario].push_back(*seconds);
    }
  }
  std::map<std::string, double> medians;
  for (const auto& [scenario, seconds] : taken) medians[scenario] = percentile(seconds, 0.5);
  return medians;
}

}  // namespace vinebench::harness
