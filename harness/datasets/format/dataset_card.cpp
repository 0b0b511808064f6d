// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/dataset_card.h"

#include <system_error>

#include "core/config/yaml.h"
#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "core/files/output_file.h"

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

bool has_partial_card_alone(const std::filesystem::path& folder) {
  std::error_code error;
  std::int64_t entries = 0;
  bool others = false;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    ++entries;
    const std::string name = it->path().filename().string();
    others = others || !name.starts_with(DatasetCard::kName) || !name.ends_with(kPartialEnding);
  }
  return !error && entries == 1 && !others;
}

}  // namespace vinebench::harness
