// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "harness/explain/explain.h"

namespace vinebench::harness {

/// For each stretch a sentence that names its causes and a table of the factors, the strongest
/// first.
std::string format_explanation(const Explanation& explanation, double rate_hz);

/// The content of explanation.json; m, s.
nlohmann::ordered_json to_json(const Explanation& explanation, double rate_hz);

}  // namespace vinebench::harness
