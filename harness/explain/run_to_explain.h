// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "harness/explain/explain.h"

namespace vinebench::harness {

/// Which part of a run to explain; all of its degraded segments, or where it has none the whole
/// drive, if none is given.
struct StretchChoice {
  std::optional<std::int64_t> number;  ///< of a degraded segment, from 1
  std::optional<double> from;          ///< s
  std::optional<double> to;            ///< s
};

/// What a run's folder says: its resolved scenario, its live poses, its degraded segments. Throws
/// Error if a file is missing or the choice does not fit.
ExplainRequest read_run(const std::filesystem::path& folder, const StretchChoice& choice);

/// The degraded segments in the text of an events.jsonl, in order, with the causes that coincide.
std::vector<Stretch> degraded_stretches(const std::string& events, double rate_hz);

}  // namespace vinebench::harness
