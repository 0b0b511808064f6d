// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/geometry/rig.h"
#include "core/slam_system.h"
#include "core/truth/sample.h"
#include "core/truth/scene_index.h"
#include "core/util/stage_timer.h"

namespace vinebench {

/// Frames in order, from a simulation, a recording or a test.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// The next sample, or nothing after the last.
  virtual std::optional<Sample> next() = 0;
  /// The estimate for the last sample, passed before the next one is requested. Ignored by most
  /// sources.
  virtual void answer(const Estimate&) {}
  /// Number of samples in total.
  virtual std::int64_t size() const = 0;
  /// The nominal rig, as given to a SLAM system.
  virtual const Rig& rig() const = 0;
  virtual const StageTimes& times() const = 0;
};

/// A simulation, with the meaning of its truth images.
class SimulatedSource : public FrameSource {
 public:
  virtual const SceneIndex& scene() const = 0;
  /// The true rig, which takes the images.
  virtual const Rig& true_rig() const = 0;
  /// A reading of the inertial unit at the start, at rest; those of the frames come after it.
  virtual std::optional<ImuSample> first_reading() const { return std::nullopt; }
};

/// What a simulation delivers for a recording: more than a SLAM system needs, or less.
struct CapturePlan {
  // Which truth images come with each image (defined by RenderedImage).
  bool labels = false;
  bool depth = false;
  bool instances = false;
  bool normals = false;
  bool motion = false;
  std::vector<bool> cameras;  ///< of the rig, which ones deliver images; all if empty
  std::int64_t first = 0;     ///< index of the first delivered frame
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t every = 1;  ///< from the first on, every N-th frame is delivered

  bool has_frame(std::int64_t index) const {
    return index >= first && index <= last && (index - first) % every == 0;
  }
  /// For a run of that many frames.
  std::int64_t count(std::int64_t frames) const {
    const std::int64_t end = std::min(last, frames - 1);
    return end < first ? 0 : (end - first) / every + 1;
  }
  bool has_camera(std::size_t camera) const { return cameras.empty() || cameras.at(camera); }
};

}  // namespace vinebench
