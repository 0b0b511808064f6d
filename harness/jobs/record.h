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
#include "harness/experiment/trust.h"
#include "harness/machine.h"
#include "sim/render/renderer_config.h"

namespace vinebench::harness {

/// The options of `vinebench record`.
struct RecordRequest {
  std::filesystem::path scenario;
  std::vector<Override> overrides;
  sim::RenderQuality quality = sim::RenderQuality::kFast;  ///< `overrides` come after it
  std::filesystem::path randomisation;  ///< distributions that each seed draws keys from; or none
  Machine machine;
  std::filesystem::path out;
  /// First and last seed. Each is a separate sequence, in a folder `seed_000012` of `out`; if
  /// absent, `out` is the single sequence of the scenario's own seed.
  std::optional<std::pair<std::int64_t, std::int64_t>> seeds;
  RecordOptions options;
  std::optional<Untrusted> untrusted{};  ///< check_untrusted() applies to the scenario
  bool resume = false;  ///< `out` may hold an interrupted recording of the same request
};

/// Progress output and interruption.
struct RecordWatch {
  std::ostream* progress = nullptr;
  bool terminal = false;
  std::function<bool()> stopped;  ///< polled before each frame
};

struct RecordOutcome {
  bool interrupted = false;
  std::int64_t sequences = 0;  ///< complete ones
  std::int64_t skipped = 0;    ///< of these, completed by an earlier recording
  std::int64_t frames = 0;     ///< recorded now
  std::uint64_t bytes = 0;     ///< likewise, of all files
};

/// Simulates without a SLAM system and records. When resuming, complete sequences are kept and an
/// incomplete one is recorded again. Throws Error for an invalid request or folder; what has been
/// recorded is kept.
RecordOutcome record_dataset(const RecordRequest& request, const RecordWatch& watch);

}  // namespace vinebench::harness
