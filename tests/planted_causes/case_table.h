// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/planted_causes/planted_case.h"

namespace vinebench::planted {

/// In Markdown: how often the causes were named, by what was planted. Cases whose planted causes
/// did no harm are counted apart and are neither right nor wrong.
std::string format_table(const std::vector<Case>& cases, const std::vector<Verdict>& verdicts);

/// What a rerun took.
std::string format_cost(const std::vector<Verdict>& verdicts);

}  // namespace vinebench::planted
