// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/util/worker_pool.h"
#include "harness/datasets/format/format_writer.h"
#include "harness/datasets/labels/image_labels.h"
#include "harness/experiment/scenario.h"
#include "harness/machine.h"
#include "harness/run/prefetch.h"

namespace vinebench::harness {

/// Which frames of a scenario are requested, with which truth.
struct StreamRequest {
  std::filesystem::path scenario;
  std::vector<Override> overrides;
  std::filesystem::path randomisation;  ///< distributions that the seed draws keys from; or none
  std::optional<std::int64_t> seed;     ///< the scenario's own if absent
  std::vector<std::string> cameras;     ///< names of the rig; all if empty
  std::vector<std::string> truth;       ///< some of truth_names()
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t every = 1;
  int threads = 2;  ///< worker threads; they change no byte
  Machine machine;
};

/// "depth", "labels", "instances", "normals", "things" and "flow".
const std::vector<std::string>& truth_names();

/// The frames of a simulated scenario in memory, in order; the next one is prefetched. Not
/// thread-safe.
class FrameStream {
 public:
  /// Builds the world. Throws Error for an invalid request.
  explicit FrameStream(const StreamRequest& request);

  const ScenarioConfig& scenario() const { return scenario_; }
  const Rig& rig() const { return source_->rig(); }  ///< nominal
  const Rig& true_rig() const { return source_->true_rig(); }
  std::int64_t size() const { return source_->size(); }

  /// Null after the last one.
  std::shared_ptr<const DatasetFrame> next();

  /// The labelled objects of an image; requires truth "things".
  ImageLabels things(const DatasetFrame& frame, std::size_t camera) const;

  /// From one frame to the next requested one, px; requires truth "flow". Throws Error for a camera
  /// with lens distortion.
  FlowTruth flow(const DatasetFrame& from, const DatasetFrame& to, std::size_t camera) const;

 private:
  ScenarioConfig scenario_;
  WorkerPool pool_;
  std::unique_ptr<SimulatedSource> source_;
  std::optional<Prefetch> ahead_;  // last member: it is destroyed first
  std::int64_t frames_ = 0;
};

}  // namespace vinebench::harness
