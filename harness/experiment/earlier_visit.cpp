// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/earlier_visit.h"

namespace vinebench::harness {

sim::SimulationConfig simulation_of(const EarlierVisit& visit, sim::SimulationConfig simulation) {
  sim::WorldConfig& world = simulation.world;
  if (visit.sun) world.sun = *visit.sun;
  if (visit.sky) world.sky = *visit.sky;
  if (visit.bbch) world.vines.bbch = *visit.bbch;
  if (!visit.waypoints.empty()) simulation.route.waypoints = visit.waypoints;
  simulation.duration = visit.duration;
  std::optional<std::int64_t>& pattern = simulation.sensors.camera.noise.pattern;
  pattern = pattern.value_or(0) + 1;
  return simulation;
}

}  // namespace vinebench::harness
