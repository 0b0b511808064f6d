// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/config/config_field.h"
#include "sim/simulation.h"

namespace vinebench::harness {

/// A drive of the same rover through the same vineyard on another day. The scenario's run begins
/// with the map of it and does not know where in it the rover is. What is absent is as in the
/// scenario itself; vines are the same plants unless the growth stage is another.
struct EarlierVisit {
  std::optional<sim::SunConfig> sun;
  std::optional<sim::SkyConfig> sky;
  std::optional<int> bbch;                            ///< growth stage of the vines
  std::vector<sim::RouteConfig::Waypoint> waypoints;  ///< empty: the scenario's
  std::optional<double> duration;                     ///< s; the whole route if absent
  template <class Archive>
  void serialize(Archive& archive) {
    archive("sun", sun);
    archive("sky", sky);
    archive("bbch", bbch);
    archive("waypoints", waypoints);
    archive("duration", duration, Range::positive());
    const std::string problem = bbch ? sim::bbch_problem(*bbch) : "";
    archive.require(problem.empty(), "bbch", problem);
  }
};

/// The simulation of that visit. Its cameras' noise is another draw.
sim::SimulationConfig simulation_of(const EarlierVisit& visit, sim::SimulationConfig simulation);

}  // namespace vinebench::harness
