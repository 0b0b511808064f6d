// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace vinebench {

/// Throws Error that names `file` if the JSON text nests lists and objects more than 200 deep:
/// parsers and what walks their trees are recursive, and a deeply nested file would exhaust the
/// stack.
void check_json_depth(std::string_view json, const std::string& file);

}  // namespace vinebench
