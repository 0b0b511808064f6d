// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sets/run_inputs.h"

#include <yaml-cpp/yaml.h>

#include <set>

#include "core/config/yaml_writer.h"
#include "core/util/files.h"
#include "harness/run/run_hash.h"

namespace vinebench::harness {
namespace {

/// Every scalar that names a file.
void gather_files(const YAML::Node& node, std::set<std::filesystem::path>& files) {
  if (node.IsScalar()) {
    const std::filesystem::path file = node.Scalar();
    std::error_code ignored;
    if (file.is_absolute() && std::filesystem::is_regular_file(file, ignored)) files.insert(file);
  } else if (node.IsSequence()) {
    for (const auto& item : node) gather_files(item, files);
  } else if (node.IsMap()) {
    for (const auto& item : node) gather_files(item.second, files);
  }
}

const std::string& program_digits() {
  static const std::string digits = [] {
    RunHash hash;
    hash.add(read_file("/proc/self/exe"));
    return hash.digits();
  }();
  return digits;
}

}  // namespace

std::string fingerprint_of_inputs(const ScenarioConfig& scenario) {
  const std::string settings = format_yaml(scenario);
  std::set<std::filesystem::path> files;
  gather_files(YAML::Load(settings), files);
  RunHash hash;
  hash.add(program_digits());
  hash.add(settings);
  for (const std::filesystem::path& file : files) {
    hash.add(file.string());
    hash.add(read_file(file));
  }
  return hash.digits();
}

}  // namespace vinebench::harness
