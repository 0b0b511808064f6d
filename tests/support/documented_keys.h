// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "core/files/files.h"

namespace vinebench::test {

/// What stands between back quotes in the first column of the table of docs/running.md that begins
/// with this row. One that begins with a dot goes on from the one before: `a.b`, `.c`.
inline std::vector<std::string> documented_keys(const std::string& header) {
  std::istringstream in(read_file(std::filesystem::path(VINEBENCH_SOURCE_DIR) / "docs/running.md"));
  std::vector<std::string> keys;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    inside = line == header || (inside && line.starts_with('|'));
    if (!inside) continue;
    const std::string cell = line.substr(1, line.find('|', 1) - 1);
    for (std::size_t begin = cell.find('`'); begin != std::string::npos;) {
      const std::size_t end = cell.find('`', begin + 1);
      std::string key = cell.substr(begin + 1, end - begin - 1);
      if (key.starts_with('.')) key.insert(0, keys.back().substr(0, keys.back().find('.')));
      keys.push_back(key);
      begin = cell.find('`', end + 1);
    }
  }
  return keys;
}

}  // namespace vinebench::test
