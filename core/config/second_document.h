// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/mark.h>

#include <optional>
#include <string>

namespace vinebench {

/// Where a YAML document after the first begins, if there is one with content. Looks at two more
/// alone: yaml-cpp gives some broken texts as empty documents without end. Throws YAML::Exception.
std::optional<YAML::Mark> second_document(const std::string& text);

}  // namespace vinebench
