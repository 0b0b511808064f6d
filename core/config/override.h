// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

namespace vinebench {

/// A dotted key and the YAML value it takes: "slam.cameras", "front".
using Override = std::pair<std::string, std::string>;

/// Splits "KEY=VALUE". Throws Error when there is no '=' or no key.
Override parse_override(const std::string& text);

}  // namespace vinebench
