// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/yaml_block.h"

#include <sstream>

namespace vinebench {

std::string with_block(const std::string& text, const std::string& key, const std::string& block) {
  std::istringstream lines(text);
  std::string before;
  std::string after;
  bool found = false;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(key + ":")) {
      found = inside = true;
      continue;
    }
    // An empty line or comment at the first column ends the block too: it is of the next key.
    if (inside && !line.starts_with(' ') && !line.starts_with('-')) inside = false;
    if (!inside) (found ? after : before) += line + "\n";
  }
  const bool apart = !found && !before.empty() && !before.ends_with("\n\n");
  return before + (apart ? "\n" : "") + block + after;
}

}  // namespace vinebench
