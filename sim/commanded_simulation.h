// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/files/cache_folder.h"
#include "core/truth/frame_source.h"
#include "core/util/worker_pool.h"
#include "sim/simulation_config.h"

namespace vinebench::sim {

class DrawnScene;

/// A simulation whose rover is driven by body twists in place of its route, from the route's first
/// waypoint, where it stands until the first command.
class CommandedSimulation : public SimulatedSource {
 public:
  /// Body twist (m/s forward, m/s left, rad/s to the left) from the latest frame's instant on,
  /// within the motors' torque. The physics is past that instant already by half the exposure and
  /// readout time, where they are simulated.
  virtual void command(const Eigen::Vector3d& twist) = 0;

  /// Whether the rover has touched anything but the ground since the latest command.
  virtual bool collided() const = 0;
};

/// As make_simulation(). It ends at the configuration's duration, and never without one.
std::unique_ptr<CommandedSimulation> make_commanded_simulation(
    const SimulationConfig& config, std::uint64_t seed, const CacheFolder& cache, WorkerPool& pool,
    const CapturePlan& plan = {}, const std::shared_ptr<DrawnScene>& drawn = nullptr);

}  // namespace vinebench::sim
