// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "core/truth/frame_source.h"
#include "core/util/worker_pool.h"
#include "harness/explain/factors.h"
#include "harness/explain/rolling_wheels.h"
#include "harness/machine.h"
#include "sim/drawn_scene.h"

namespace vinebench::harness {

/// Where a variant takes over from the drive as it was.
struct Splice {
  std::int64_t first = 0;  ///< index of the variant's first frame; 0: all of them
  Stamp before = 0;        ///< ns, stamp of the frame before that one, as it was
  /// The last pose of the true path up to that frame, as it was.
  std::optional<StampedPose> path_end{};
};

/// The frames of a variant from a splice on: the drive before it is simulated and not rendered.
/// The first frame has the readings since the frame before it, so that the frames as they were and
/// these are one drive.
class VariantDrive : public FrameSource {
 public:
  /// Up to the frame of index `last`. Draws with `drawn` if it serves the variant; else it starts
  /// OpenGL if the scenario draws with it.
  VariantDrive(const Variant& variant, const Splice& splice, std::int64_t last,
               const Machine& machine, WorkerPool& pool,
               const std::shared_ptr<sim::DrawnScene>& drawn = nullptr);

  std::optional<Sample> next() override;
  std::int64_t size() const override { return simulation_->size(); }
  const Rig& rig() const override { return rig_; }
  const StageTimes& times() const override { return simulation_->times(); }

  /// Whether the rover came to the splice exactly as it did; known after the first frame. Else the
  /// variant's drive is another one from the start on.
  bool is_same_drive() const { return same_drive_; }

 private:
  void join(Sample& sample);

  Splice splice_;
  std::unique_ptr<SimulatedSource> simulation_;
  Rig rig_;  ///< that the estimator is given
  std::optional<RollingWheels> rolling_;
  bool joined_ = false;
  bool same_drive_ = true;
};

/// The rig that a variant's estimator is given.
Rig told_rig(const Variant& variant);

}  // namespace vinebench::harness
