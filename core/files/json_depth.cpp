// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/json_depth.h"

#include "core/util/error.h"

namespace vinebench {

void check_json_depth(std::string_view json, const std::string& file) {
  constexpr int kDeepest = 200;
  int depth = 0;
  bool text = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '"') text = !text;
    if (text && c == '\\') ++i;
    if (text) continue;
    depth += (c == '{' || c == '[') - (c == '}' || c == ']');
    if (depth > kDeepest) fail("{}: its JSON is nested more than {} deep", file, kDeepest);
  }
}

}  // namespace vinebench
