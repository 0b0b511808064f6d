// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vinebench::harness {

/// Reads seeds as a person writes them: "3", "1..5", "1..3,7". In the order given. Throws Error for
/// anything else, a range that runs backwards, a seed that stands twice, and more than 10,000.
std::vector<std::int64_t> parse_seeds(const std::string& text);

}  // namespace vinebench::harness
