// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "harness/experiment/scenario.h"

namespace vinebench::harness {

/// Hash of this program's executable.
const std::string& program_digits();

/// What a scenario's runs are made from: this program's executable, the resolved scenario, and the
/// files that it names. Files that those name in turn (a rover's meshes) are not included.
class RunInputs {
 public:
  /// Reads the files. Throws Error.
  explicit RunInputs(ScenarioConfig scenario);

  /// Of the run with that seed, 32 hexadecimal digits.
  std::string fingerprint(std::int64_t seed) const;

 private:
  std::string digits_;  ///< of all but the seed
};

/// The same of one run.
inline std::string fingerprint_of_inputs(const ScenarioConfig& scenario) {
  return RunInputs(scenario).fingerprint(scenario.seed);
}

}  // namespace vinebench::harness
