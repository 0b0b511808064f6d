// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/config_files.h"

#include "core/config/yaml.h"

namespace vinebench::sim {

WorldConfig load_world(const std::filesystem::path& file,
                       const std::vector<std::pair<std::string, std::string>>& overrides) {
  YamlDocument document = YamlDocument::load(file);
  for (const auto& [key, value] : overrides) document.set(key, value);
  return document.read<WorldConfig>();
}

RoverConfig load_rover(const std::filesystem::path& file) {
  return YamlDocument::load(file).read<RoverConfig>();
}

}  // namespace vinebench::sim
