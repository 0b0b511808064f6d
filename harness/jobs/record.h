// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <ostream>
#include <vector>

#include "harness/datasets/format/record_options.h"
#include "harness/experiment/scenario.h"

namespace vinebench::harness {

/// What `vinebench record` is asked for.
struct RecordRequest {
  std::filesystem::path scenario;
  std::vector<Override> overrides;
  std::filesystem::path randomisation;  ///< distributions that each seed draws keys from; or none
  std::filesystem::path out;
  /// First and last seed. Each makes a sequence of its own, in a folder `seed_000012` of `out`;
  /// where absent, `out` is the one sequence of the scenario's own seed.
  std::optional<std::pair<std::int64_t, std::int64_t>> seeds;
  RecordOptions options;
  bool resume = false;  ///< `out` may hold an interrupted recording of the same request
};

/// How a person is told of it.
struct RecordWatch {
  std::ostream* progress = nullptr;
  bool terminal = false;
  std::function<bool()> stopped;  ///< asked before each frame
};

struct RecordOutcome {
  bool interrupted = false;
  std::int64_t sequences = 0;  ///< that are complete
  std::int64_t skipped = 0;    ///< of these, what an earlier recording had completed
  std::int64_t frames = 0;     ///< recorded now
  std::uint64_t bytes = 0;     ///< likewise, in images
};

/// Simulates without a SLAM system and records. Sequences that are complete are kept where it
/// resumes, one that is not is recorded anew. Throws Error for what is wrong with the request or
/// its folder; what is recorded by then is kept.
RecordOutcome record_dataset(const RecordRequest& request, const RecordWatch& watch);

}  // namespace vinebench::harness
