// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/config/override.h"
#include "core/geometry/rig.h"
#include "slam/config.h"
#include "tests/mutants/faulty_slam.h"

namespace vinebench::mutants {

/// What the estimator is told of rover and world.
struct Told {
  Rig rig;
  std::vector<RegisteredTag> tags;
  slam::SlamConfig config;
};

/// A planted fault: the estimator is told something that is not so, the simulation differs from
/// what the scenario says, or the estimate is misreported.
struct Mutant {
  std::string name;
  std::string part;  ///< "calibration", "survey", "sensors" or "estimator"
  std::string text;  ///< what is wrong, for the table
  std::function<void(Told&)> tell{};
  std::vector<Override> settings{};  ///< of the scenario, as for `vinebench run --set`
  std::optional<EstimatorFault> fault{};
};

/// All faults that are planted, on a rig with the pairs "front" and "back" of cameras
/// "front_left" and so on, the tag camera "side", and at least one registered tag.
std::vector<Mutant> all_mutants();

/// What the diagnosis must name: a discrepancy ("front pair: baseline"), a pattern of the error
/// ("late"), a cause of degraded segments, or one of several, with "|" between them.
std::string cause_of(const std::string& mutant);

}  // namespace vinebench::mutants
