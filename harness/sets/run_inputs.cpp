// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/run_inputs.h"

#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "harness/experiment/trust.h"
#include "harness/run/run_hash.h"

namespace vinebench::harness {

const std::string& program_digits() {
  static const std::string digits = [] {
    RunHash hash;
    hash.add(read_file("/proc/self/exe"));
    return hash.digits();
  }();
  return digits;
}

RunInputs::RunInputs(ScenarioConfig scenario) {
  scenario.seed = 0;
  RunHash hash;
  hash.add(program_digits());
  hash.add(format_yaml(scenario));
  for (const std::filesystem::path& file : files_of(scenario)) {
    hash.add(file.string());
    hash.add(read_file(file));
  }
  digits_ = hash.digits();
}

std::string RunInputs::fingerprint(std::int64_t seed) const {
  RunHash hash;
  hash.add(digits_);
  hash.add(std::to_string(seed));
  return hash.digits();
}

}  // namespace vinebench::harness
