// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace vinebench {

/// Insertions, deletions, replacements and swaps of neighbours that make one word the other
/// (optimal string alignment).
int edit_distance(const std::string& a, const std::string& b);

/// "; did you mean 'NAME'?" with the nearest of the names, the first of equals; empty where none
/// takes at most a third of the word's letters (at least one) to change.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

}  // namespace vinebench
