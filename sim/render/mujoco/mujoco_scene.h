// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <vector>

#include "sim/scene/scene.h"

namespace vinebench::sim {

/// A scene as MuJoCo holds it: a model of static geoms and its state.
class MujocoScene {
 public:
  /// Takes each model at the level of detail that is drawn `level_distance` m from a camera of
  /// kLevelFocalLength (MuJoCo knows no levels); what is no longer drawn there is left out. Cut-out
  /// textures become opaque (MuJoCo's have no alpha), wires become cylinders. `width` x `height`
  /// is the largest image to be drawn, px. Throws Error with MuJoCo's reason.
  MujocoScene(const Scene& scene, double level_distance, int width, int height);

  const mjModel& model() const { return *model_; }
  mjData& state() { return *state_; }

  /// Triangles of all geoms that are meshes.
  std::int64_t triangles() const;

 private:
  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* state) const { mj_deleteData(state); }
  };
  void enlarge(const Scene& scene);

  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> state_;
};

}  // namespace vinebench::sim
