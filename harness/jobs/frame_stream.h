// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "core/util/worker_pool.h"
#include "harness/jobs/simulated_frames.h"
#include "harness/run/prefetch.h"

namespace vinebench::harness {

/// Which frames of a scenario are requested, with which truth.
struct StreamRequest : FramesRequest {
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t every = 1;
};

/// The frames of a simulated scenario in memory, in order; the next one is prefetched. Not
/// thread-safe.
class FrameStream : public SimulatedFrames {
 public:
  /// Builds the world. Throws Error for an invalid request.
  explicit FrameStream(const StreamRequest& request);

  const ScenarioConfig& scenario() const override { return scenario_; }
  std::int64_t size() const { return source_->size(); }

  /// Null after the last one.
  std::shared_ptr<const DatasetFrame> next();

 private:
  const SimulatedSource& source() const override { return *source_; }

  ScenarioConfig scenario_;
  WorkerPool pool_;
  std::unique_ptr<SimulatedSource> source_;
  std::optional<Prefetch> ahead_;  // last member: it is destroyed first
  std::int64_t frames_ = 0;
};

}  // namespace vinebench::harness
