// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/dataset_card.h"

#include <system_error>

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "core/util/files.h"

namespace vinebench::harness {

DatasetCard read_card(const std::filesystem::path& folder) {
  return YamlDocument::load(folder / DatasetCard::kName).read<DatasetCard>();
}

void write_card(const std::filesystem::path& folder, const DatasetCard& card) {
  write_file_atomically(folder / DatasetCard::kName, format_yaml(card));
}

bool has_card(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / DatasetCard::kName, ignored);
}

}  // namespace vinebench::harness
