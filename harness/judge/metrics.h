// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "core/util/stage_timer.h"
#include "harness/judge/results.h"
#include "harness/judge/verdict.h"

namespace vinebench::harness {

using Json = nlohmann::ordered_json;

/// The part of metrics.json that is a function of scenario, seed and build. Metrics that could not
/// be measured are null.
Json result_metrics(const Trial& trial, const RunRecord& record, const RunResults& results);

/// Metrics that came later, which the run's hash leaves out, so that hashes of earlier builds stay
/// comparable: what covered each camera, by class; frames that the consistency check left out.
void add_unhashed_metrics(const RunRecord& record, const RunResults& results, Json& metrics);

/// Mean, median and 95th percentile of each stage, ms per call.
Json timing_metrics(const StageTimes& times);

/// Quantile for `share` (0 to 1), linearly interpolated. Requires at least one sample.
double percentile(std::vector<double> samples, double share);

/// Peak memory of this process, MiB.
double peak_rss_mib();

/// CPU time of this process' threads and of child processes that have been waited for, s, since the
/// program started (the process may have been a shell before).
double cpu_seconds();

/// Conversion of checked expectations to metrics.json and back.
Json checks_json(const std::vector<Check>& checks);
std::vector<Check> checks_of(const Json& list);

}  // namespace vinebench::harness
