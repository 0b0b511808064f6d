// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "harness/judge/run_report.h"

namespace vinebench::harness {

using Json = nlohmann::ordered_json;

/// metrics.json. Metrics that could not be measured are null.
Json to_json(const RunReport& report);

/// The part of metrics.json that the run's hash covers: a function of scenario, seed and build.
/// Metrics that came later are left out, so that hashes of earlier builds stay comparable.
Json hashed_json(const RunReport& report);

/// Conversion of checked expectations to metrics.json and back.
Json checks_json(const std::vector<Check>& checks);
std::vector<Check> checks_of(const Json& list);

}  // namespace vinebench::harness
