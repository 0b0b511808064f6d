// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/util/worker_pool.h"
#include "harness/jobs/simulated_frames.h"
#include "sim/commanded_simulation.h"
#include "sim/drawn_scene.h"

namespace vinebench::harness {

/// A scenario whose rover is driven by body twists in place of its route, one frame after the
/// other. Each frame is computed when it is asked for, after the physics has reached its instant:
/// nothing is prefetched, so the images are those of the returned state. Not thread-safe.
class CommandedDrive : public SimulatedFrames {
 public:
  /// Builds the world. Throws Error for an invalid request.
  explicit CommandedDrive(const FramesRequest& request);

  const ScenarioConfig& scenario() const override { return scenario_; }

  /// Begins anew and returns the first frame. The rover stands at `start` (x, y in m, heading in
  /// rad, world), else at the route's first waypoint. With another seed the world is built anew;
  /// with the same one its scene is kept. Throws Error for a start inside an obstacle.
  std::shared_ptr<const DatasetFrame> reset(std::optional<std::int64_t> seed,
                                            const std::optional<Eigen::Vector3d>& start);

  /// Drives by a body twist (m/s forward, m/s left, rad/s to the left) until the next frame's
  /// instant, and returns that frame; null at the end of the scenario's `duration`. Throws Error
  /// before the first reset(), and for a twist that is not finite.
  std::shared_ptr<const DatasetFrame> step(const Eigen::Vector3d& twist);

  /// Whether the rover has touched anything but the ground during the latest step.
  bool collided() const { return drive_ && drive_->collided(); }

  /// The number of the last frame, at the scenario's `duration`; none if it goes on forever.
  std::optional<std::int64_t> last_number() const;

  /// x, y (m), heading (rad) of each waypoint of the scenario's route.
  std::vector<Eigen::Vector3d> route() const;

 private:
  const SimulatedSource& source() const override;
  void begin(const std::optional<Eigen::Vector3d>& start);
  std::shared_ptr<const DatasetFrame> next();

  FramesRequest request_;
  ScenarioConfig scenario_;
  WorkerPool pool_;
  std::shared_ptr<sim::DrawnScene> drawn_;
  std::unique_ptr<sim::CommandedSimulation> drive_;
  std::int64_t frames_ = 0;
};

}  // namespace vinebench::harness
