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
#include "harness/datasets/format/dataset_format.h"
#include "harness/datasets/labels/image_labels.h"
#include "harness/experiment/scenario.h"
#include "harness/run/prefetch.h"

namespace vinebench::harness {

/// Which frames of a scenario are wanted, and what comes with their images.
struct StreamRequest {
  std::filesystem::path scenario;
  std::vector<Override> overrides;
  std::filesystem::path randomisation;  ///< distributions that the seed draws keys from; or none
  std::optional<std::int64_t> seed;     ///< the scenario's own where absent
  std::vector<std::string> cameras;     ///< names of the rig; all where empty
  std::vector<std::string> truth;       ///< some of truth_names()
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t every = 1;
  int threads = 2;  ///< that share the work; they change no byte
};

/// "depth", "labels", "instances", "normals", "things" and "flow".
const std::vector<std::string>& truth_names();

/// The frames of a simulated scenario in memory, in order; the next one is made while one is looked
/// at. One thread uses it at a time.
class FrameStream {
 public:
  /// Builds the world. Throws Error for what is wrong with the request.
  explicit FrameStream(const StreamRequest& request);

  const ScenarioConfig& scenario() const { return scenario_; }
  const Rig& rig() const { return source_->rig(); }  ///< as a SLAM system is told of it
  const Rig& true_rig() const { return source_->true_rig(); }
  std::int64_t size() const { return source_->size(); }

  /// Null after the last one.
  std::shared_ptr<const DatasetFrame> next();

  /// The things of a frame's image; of the request's truth, "things" is needed.
  ImageLabels things(const DatasetFrame& frame, std::size_t camera) const;

  /// From one frame to the next one asked for, px; "flow" is needed. Throws Error for a camera with
  /// lens distortion.
  FlowTruth flow(const DatasetFrame& from, const DatasetFrame& to, std::size_t camera) const;

 private:
  ScenarioConfig scenario_;
  WorkerPool pool_;
  std::unique_ptr<SimulatedSource> source_;
  std::optional<Prefetch> ahead_;  // last: it must go first
  std::int64_t frames_ = 0;
};

}  // namespace vinebench::harness
