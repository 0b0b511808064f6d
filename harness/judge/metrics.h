// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "core/util/stage_timer.h"
#include "harness/judge/results.h"
#include "harness/judge/verdict.h"

namespace vinebench::harness {

using Json = nlohmann::ordered_json;

/// The part of metrics.json that is a function of scenario, seed and build. What could not be
/// measured is null.
Json result_metrics(const Trial& trial, const RunRecord& record, const RunResults& results);

/// Mean, median and 95th percentile of each stage, ms a call.
Json timing_metrics(const StageTimes& times);

/// Value below which `share` (0 to 1) of the samples lie, linear between neighbours. Needs a
/// sample.
double percentile(std::vector<double> samples, double share);

/// The most memory this process ever held, MiB.
double peak_rss_mib();

/// CPU time of this process' threads and of the children that it waited for, s.
double cpu_seconds();

/// Expectations and what became of them as they stand in metrics.json, and back.
Json checks_json(const std::vector<Check>& checks);
std::vector<Check> checks_of(const Json& list);

}  // namespace vinebench::harness
