// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/cultivar.h"

#include "core/config/yaml.h"

namespace vinebench::sim {

Cultivar load_cultivar(const std::filesystem::path& file) {
  return file.empty() ? Cultivar{} : YamlDocument::load(file).read<Cultivar>();
}

}  // namespace vinebench::sim
