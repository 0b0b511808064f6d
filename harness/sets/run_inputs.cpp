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

std::string fingerprint_of_inputs(const ScenarioConfig& scenario) {
  const std::string settings = format_yaml(scenario);
  RunHash hash;
  hash.add(program_digits());
  hash.add(settings);
  for (const std::filesystem::path& file : files_of(scenario)) {
    hash.add(file.string());
    hash.add(read_file(file));
  }
  return hash.digits();
}

}  // namespace vinebench::harness
