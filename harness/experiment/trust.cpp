// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/trust.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <system_error>

#include "core/config/yaml_writer.h"
#include "core/util/error.h"
#include "harness/systems/other_system.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

/// Every scalar that names a file.
void gather_files(const YAML::Node& node, std::set<fs::path>& files) {
  if (node.IsScalar()) {
    const fs::path file = node.Scalar();
    std::error_code ignored;
    if (file.is_absolute() && fs::is_regular_file(file, ignored)) files.insert(file);
  } else if (node.IsSequence()) {
    for (const auto& item : node) gather_files(item, files);
  } else if (node.IsMap()) {
    for (const auto& item : node) gather_files(item.second, files);
  }
}

bool lies_in(const fs::path& real_file, const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  return !error && std::ranges::mismatch(real, real_file).in1 == real.end();
}

}  // namespace

std::set<fs::path> files_of(const ScenarioConfig& scenario) {
  std::set<fs::path> files;
  gather_files(YAML::Load(format_yaml(scenario)), files);
  return files;
}

void check_untrusted(const ScenarioConfig& scenario, const fs::path& file,
                     const Untrusted& untrusted) {
  expect_no_code(scenario.slam, file);
  std::vector<fs::path> folders = untrusted.data_folders;
  folders.push_back(fs::absolute(file).parent_path());
  for (const fs::path& named : files_of(scenario)) {
    std::error_code error;
    const fs::path real = fs::canonical(named, error);
    const auto has_file = [&](const fs::path& folder) { return lies_in(real, folder); };
    if (!error && std::ranges::any_of(folders, has_file)) continue;
    fail(
        "{}: names {}, which lies neither in the scenario's folder nor in the program's data; "
        "--untrusted allows no other files",
        file.string(), named.string());
  }
}

}  // namespace vinebench::harness
