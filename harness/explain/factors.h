// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/experiment/scenario.h"

namespace vinebench::harness {

/// A scenario with some of its hard effects taken away.
struct Variant {
  ScenarioConfig scenario;
  bool ideal_lenses = false;  ///< of the true cameras and of the rig that the estimator is given
  bool without_slip = false;  ///< the encoders read what wheels that roll would turn
};

/// A hard effect that a scenario may have.
struct Factor {
  std::string name{};  ///< short, unique: "occluder-carton"
  std::string text{};  ///< for people: "static occluders (carton)"
  /// Taken away from the drive's start on and not just before the stretch: what it changes remains
  /// in the map (the light, the calibration), or the estimator is told of it at its construction.
  bool from_start = false;
  std::function<void(Variant&)> remove{};
};

/// The factors that a scenario has, in a fixed order: those whose removal changes it. Throws Error
/// if the rig's file cannot be read.
std::vector<Factor> factors_of(const ScenarioConfig& scenario);

/// A placebo: another draw of the images' noise; what changes then is chance. Without noise, one of
/// a quarter of a grey level.
Variant with_other_noise(Variant variant, int number);

}  // namespace vinebench::harness
