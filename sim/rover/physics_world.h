// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <memory>
#include <string>

#include "sim/world/world.h"

namespace vinebench::sim {

class Terrain;

/// The MJCF text of a world: ground, posts, trunks and carton boxes as static geoms, and the rover
/// by include. `rover_include` is the rover's MJCF file as the text's own folder reaches it. `seed`
/// decides, as in build_scene, where vines are missing.
std::string world_mjcf(const WorldConfig& world, const std::filesystem::path& rover_include,
                       std::uint64_t seed = 1);

/// A MuJoCo model and its state. Positions and velocities always belong to the same instant:
/// `step` integrates and then evaluates what depends on them, so poses, encoders and gyro are those
/// of the step's end, and the accelerometer's is the acceleration that held during the step.
class PhysicsWorld {
 public:
  /// Throws Error that names `rover` when it is missing or no valid MJCF.
  PhysicsWorld(const std::filesystem::path& rover, const WorldConfig& world,
               std::uint64_t seed = 1);

  const mjModel& model() const { return *model_; }
  mjModel& model() { return *model_; }
  mjData& state() { return *state_; }
  const mjData& state() const { return *state_; }

  /// Evaluates what depends on positions and velocities, after these were set from outside.
  void refresh() { mj_step1(model_.get(), state_.get()); }

  /// One step of model().opt.timestep under the controls in the state.
  void step() {
    mj_step2(model_.get(), state_.get());
    mj_step1(model_.get(), state_.get());
  }

  /// Throws Error where MuJoCo met a numerical problem (it would go on from a reset state) or ran
  /// out of contacts.
  void check() const;

  /// Index of a named object. Throws Error that names the rover's file where there is none.
  int find(mjtObj type, const std::string& name) const;
  /// Address of a named sensor's first number in mjData::sensordata.
  int sensor_address(const std::string& name) const;

 private:
  void raise_ground(const Terrain& terrain);

  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* state) const { mj_deleteData(state); }
  };
  std::filesystem::path rover_;
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> state_;
};

}  // namespace vinebench::sim
