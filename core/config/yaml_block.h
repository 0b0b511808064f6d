// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vinebench {

/// The text of a YAML file with this block, which begins with `key:` at the first column, in place
/// of the one that it has of that key, else at its end. All else stays as it is.
std::string with_block(const std::string& text, const std::string& key, const std::string& block);

}  // namespace vinebench
