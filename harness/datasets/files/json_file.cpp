// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/json_file.h"

#include "core/files/files.h"
#include "core/files/json_depth.h"
#include "core/util/error.h"

namespace vinebench::harness {

nlohmann::ordered_json read_json(const std::filesystem::path& file) {
  const std::string text = read_file(file, FileKind::kJson);
  check_json_depth(text, file.string());
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::ordered_json::exception& error) {
    fail("{}: is not valid JSON: {}", file.string(), error.what());
  }
}

std::string json_text(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace vinebench::harness
