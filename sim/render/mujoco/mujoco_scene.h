// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/pose.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// A scene as MuJoCo holds it: a model of static geoms and its state.
class MujocoScene {
 public:
  /// Takes each model at the level of detail that is drawn `level_distance` m from a camera of
  /// kLevelFocalLength (MuJoCo knows no levels); what is no longer drawn there is left out. Cut-out
  /// textures become opaque (MuJoCo's have no alpha), wires become cylinders. Throws Error
  /// with MuJoCo's reason.
  MujocoScene(const Scene& scene, double level_distance);

  /// The size of the largest image to be drawn from now on, px.
  void set_image_size(int width, int height);

  /// Puts the scene's rover there; out of sight where absent.
  void place_rover(const std::optional<Pose>& T_world_rover);

  /// Puts what moves where it is at a time, s.
  void place_movers(double time);

  /// Index into Scene::instances of a geom; -1 of a wire, -2 of the rover.
  int instance_of(int geom) const { return static_cast<int>(model_->geom_user[geom]); }

  const mjModel& model() const { return *model_; }
  mjData& state() { return *state_; }

  /// Triangles of all geoms that are meshes.
  std::int64_t triangles() const;

 private:
  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* state) const { mj_deleteData(state); }
  };
  /// A geom of something rigid.
  struct BodyGeom {
    int geom = 0;
    Eigen::Vector3d at;  ///< of its middle, m, in the body's frame
    Eigen::Matrix3d R_body_geom;
  };
  using Body = std::vector<BodyGeom>;
  void enlarge(const Scene& scene);
  Body find_body(int number, const Pose& T_world_body) const;
  void place(const Body& body, const Pose& T_world_body);

  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> state_;
  Body rover_;
  std::vector<std::pair<Motion, Body>> moving_;
};

}  // namespace vinebench::sim
