// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// The drive in the file with these causes (indices into all_causes()) and two mild other ones,
/// drawn by the seed.
harness::ScenarioConfig planted_drive(const std::filesystem::path& file,
                                      const std::vector<std::size_t>& causes, std::int64_t seed);

}  // namespace vinebench::planted
