// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vinebench::harness {

/// Parses a list of seeds: "3", "1..5", "1..3,7", in the given order. Throws Error for anything
/// else, a descending range, a repeated seed, and more than 10,000.
std::vector<std::int64_t> parse_seeds(const std::string& text);

}  // namespace vinebench::harness
