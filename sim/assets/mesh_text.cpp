// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/mesh_text.h"

namespace vinebench::sim {

UpAxis collada_up_axis(std::string_view text) {
  constexpr std::string_view kTag = "<up_axis>";
  const std::size_t at = text.find(kTag);
  if (at == text.npos) return UpAxis::kY;
  const std::string_view value = text.substr(at + kTag.size());
  const std::size_t letter = value.find_first_not_of(" \t\r\n");
  if (letter == value.npos) return UpAxis::kY;
  return value[letter] == 'Z' ? UpAxis::kZ : value[letter] == 'X' ? UpAxis::kX : UpAxis::kY;
}

std::vector<std::string> missing_material_libraries(std::string_view text,
                                                    const std::filesystem::path& folder) {
  constexpr std::string_view kStatement = "mtllib", kBlank = " \t\r";
  std::vector<std::string> missing;
  for (std::size_t at = text.find(kStatement); at != text.npos;
       at = text.find(kStatement, at + 1)) {
    if (at > 0 && text[at - 1] != '\n') continue;
    std::string_view name = text.substr(at, text.find('\n', at) - at).substr(kStatement.size());
    const std::size_t first = name.find_first_not_of(kBlank);
    if (first == name.npos || first == 0) continue;
    name = name.substr(first, name.find_last_not_of(kBlank) + 1 - first);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(folder / name, ignored)) missing.emplace_back(name);
  }
  return missing;
}

}  // namespace vinebench::sim
