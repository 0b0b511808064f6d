// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

namespace vinebench {

/// A dotted key and its YAML value: "slam.cameras", "front".
using Override = std::pair<std::string, std::string>;

/// Splits "KEY=VALUE". Throws Error if '=' or the key is missing.
Override parse_override(const std::string& text);

}  // namespace vinebench
