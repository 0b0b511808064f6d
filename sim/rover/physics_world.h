// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/world/occluder_pose.h"
#include "sim/world/world.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {

/// The MJCF text of a world: ground, posts, trunks and occluders as static geoms, occluders that
/// move as mocap bodies, and the rover by include. `rover_include` is the rover's MJCF file
/// relative to the text's folder; `layout` is lay_out(world). `seed` selects, as in build_scene,
/// the missing vines.
std::string world_mjcf(const WorldConfig& world, const WorldLayout& layout,
                       const std::filesystem::path& rover_include, std::uint64_t seed = 1);

/// A MuJoCo model and its state. Positions and velocities always belong to the same instant: `step`
/// integrates and then evaluates what depends on them, so poses, encoders and gyro refer to the
/// step's end, and the accelerometer to the acceleration during the step.
class PhysicsWorld {
 public:
  /// Throws Error that names `rover` if it is missing or not valid MJCF.
  PhysicsWorld(const std::filesystem::path& rover, const WorldConfig& world,
               std::uint64_t seed = 1);

  const mjModel& model() const { return *model_; }
  mjModel& model() { return *model_; }
  mjData& state() { return *state_; }
  const mjData& state() const { return *state_; }

  /// Updates derived quantities after positions or velocities were set from outside.
  void refresh() { mj_step1(model_.get(), state_.get()); }

  /// One step of model().opt.timestep under the controls in the state.
  void step() {
    mj_step2(model_.get(), state_.get());
    mj_step1(model_.get(), state_.get());
  }

  /// Moves the occluders that have a path to where they are then; the next evaluation of the state
  /// takes account of it.
  void move_occluders(Stamp stamp);

  /// Throws Error if MuJoCo had a numerical problem (it would continue from a reset state) or ran
  /// out of contacts.
  void check() const;

  /// Index of a named object. Throws Error that names the rover's file if there is none.
  int find(mjtObj type, const std::string& name) const;
  /// Address of a named sensor's data in mjData::sensordata.
  int sensor_address(const std::string& name) const;

 private:
  void raise_ground(const Terrain& terrain);

  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* state) const { mj_deleteData(state); }
  };
  /// Index of the mocap body, and its motion.
  using MovingOccluder = std::pair<int, OccluderMotion>;

  std::filesystem::path rover_;
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> state_;
  std::vector<MovingOccluder> moving_;
};

}  // namespace vinebench::sim
