// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/experiment/scenario.h"
#include "harness/judge/bounds.h"

namespace vinebench::harness {

/// What is true of a drive by its route alone, without physics, images and occluders.
struct RouteOutlook {
  int frames = 0;
  double reach = 0;  ///< m, farthest from the start
  int returns = 0;   ///< to tags, that must lead to a loop closure
};
/// Throws Error if the rig cannot be read.
RouteOutlook route_outlook(const ScenarioConfig& scenario);

/// Why no run of that drive can fail this bound: a share or count that nothing is below or above,
/// more losses than frames allow, missed loop closures where the route returns to no more tags, an
/// error above that of an estimate that stands still, an angle of half a turn. Empty if one can.
std::string why_ineffective(const Bound& bound, double value, const RouteOutlook& drive);

/// A bound that no run of its scenario can fail.
struct IneffectiveBound {
  std::string part;  ///< "expectations", "goal" or "guard"
  std::string key;   ///< of Expectations
  std::string reason;

  std::string text() const;
};

/// Those of a scenario: why_ineffective(), and medians above the bound of each run. Throws Error if
/// the rig cannot be read.
std::vector<IneffectiveBound> ineffective_bounds(const ScenarioConfig& scenario);

}  // namespace vinebench::harness
