// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/util/random.h"
#include "harness/experiment/scenario.h"
#include "harness/judge/degraded_segments.h"

namespace vinebench::planted {

/// What makes a drive hard, or in its mild form hardly does.
struct PlantedCause {
  std::string name;  ///< of the factor (harness/explain/factors.h)
  /// Plants it, with a strength that the draws decide; empty for one that harms this drive little.
  std::function<void(harness::ScenarioConfig&, RandomSequence&)> plant;
  /// A little of it, as a distraction; may be empty.
  std::function<void(harness::ScenarioConfig&)> plant_mild{};
  /// What the diagnosis by coincidence calls it, if it can.
  std::vector<harness::Cause> coinciding{};
};

const std::vector<PlantedCause>& all_causes();

/// A drive with one cause, two, or none (indices into all_causes()).
struct Case {
  std::vector<std::size_t> causes;
  std::int64_t seed = 1;

  std::vector<std::string> names() const;
};

/// The part of the drive that is explained, which lasts to its end.
inline constexpr double kStretchFrom = 2.0;  // s
inline constexpr double kLead = 0.6;         // s
inline constexpr double kRate = 15;          // Hz, the rig's

/// Its drive, with two mild other causes that the seed draws; of its own ones `planted` alone. The
/// strength of a cause depends on the seed alone.
harness::ScenarioConfig planted_drive(const Case& one, const std::vector<std::size_t>& planted);
inline harness::ScenarioConfig planted_drive(const Case& one) {
  return planted_drive(one, one.causes);
}

}  // namespace vinebench::planted
