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
    const auto code = static_cast<unsigned char>(c);
    const bool control = code < ' ' || code == 0x7f;
    quoted += c == '\n' ? "\\n" : control ? fmt::format("\\x{:02x}", code) : std::string(1, c);
  }
  return quoted + "\"";
}

std::string YamlWriter::scalar(double value) {
  return fmt::format("{}", value);
}

}  // namespace vinebench
