// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/yaml_writer.h"

#include <fmt/format.h>

namespace vinebench {

void YamlWriter::line(const std::string& content) {
  text_ += std::string(static_cast<std::size_t>(2 * depth_), ' ') + content + "\n";
}

std::string YamlWriter::quote(const std::string& value) {
  std::string quoted = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? "\\n" : std::string(1, c);
  }
  return quoted + "\"";
}

std::string YamlWriter::scalar(double value) {
  return fmt::format("{}", value);
}

}  // namespace vinebench
