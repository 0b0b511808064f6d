// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <string>

#include "core/geometry/camera.h"
#include "core/geometry/pose.h"
#include "sim/scene/scene.h"

namespace vinebench::test {

/// The tracking cameras of the default rig.
inline PinholeCamera small_camera() {
  return {752, 480, 263.2786, 263.2786, 375.5, 239.5, {}};
}

/// The side camera of the default rig.
inline PinholeCamera large_camera() {
  return {1920, 1080, 733, 733, 959.5, 539.5, {}};
}

/// A camera at `camera` that looks at `target`, rolled about its optical axis; world z is up.
inline Pose look_at(const Eigen::Vector3d& camera, const Eigen::Vector3d& target, double roll = 0) {
  const Eigen::Vector3d z = (target - camera).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d R_world_cam;
  R_world_cam << x, z.cross(x), z;
  const Eigen::AngleAxisd about_axis(roll, Eigen::Vector3d::UnitZ());
  return {Eigen::Quaterniond(R_world_cam * about_axis), camera};
}

inline int add_material(sim::Scene& scene, Label label, const Eigen::Vector3f& colour,
                        const cv::Mat& rgba = {}) {
  sim::Material material;
  material.name = "material " + std::to_string(scene.materials.size());
  material.label = label;
  material.colour = colour;
  if (!rgba.empty()) {
    material.texture = static_cast<int>(scene.textures.size());
    scene.textures.push_back({material.name, rgba, false});
  }
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

/// A rectangle of the plane y = 0 around the origin that faces -y, towards a camera that looks
/// along +y: the image's top left is at (-width / 2, 0, height / 2).
inline sim::Primitive panel(int material, double width, double height) {
  const auto w = static_cast<float>(width / 2);
  const auto h = static_cast<float>(height / 2);
  const Eigen::Vector3f normal = -Eigen::Vector3f::UnitY();
  sim::Primitive p;
  p.material = material;
  p.vertices = {{{-w, 0, h}, normal, {0, 0}, 1},
                {{-w, 0, -h}, normal, {0, 1}, 1},
                {{w, 0, -h}, normal, {1, 1}, 1},
                {{w, 0, h}, normal, {1, 0}, 1}};
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

inline int add_model(sim::Scene& scene, const sim::Primitive& primitive) {
  sim::Model model;
  model.levels.push_back({1e9, {primitive}});
  for (const sim::Vertex& vertex : primitive.vertices) model.bounds.extend(vertex.position);
  scene.models.push_back(model);
  return static_cast<int>(scene.models.size()) - 1;
}

inline void add_instance(sim::Scene& scene, int model, const Eigen::Vector3d& position) {
  scene.instances.push_back({model,
                             {Eigen::Quaterniond::Identity(), position},
                             1.0f,
                             static_cast<int>(scene.instances.size())});
}

/// A horizontal square around the origin, face up.
inline sim::Primitive flat_panel(int material, double side) {
  sim::Primitive primitive = panel(material, side, side);
  for (sim::Vertex& vertex : primitive.vertices) {
    vertex.position = {vertex.position.x(), vertex.position.z(), 0};
    vertex.normal = Eigen::Vector3f::UnitZ();
  }
  return primitive;
}

/// Even ground from (-2, -4) to (10, 6).
inline void add_even_ground(sim::Scene& scene) {
  const int soil = add_material(scene, Label::kGround, {0.3f, 0.25f, 0.2f});
  scene.materials[static_cast<std::size_t>(soil)].terrain = true;
  const int tile = add_model(scene, flat_panel(soil, 0.5));
  for (int x = -4; x < 20; ++x) {
    for (int y = -8; y < 12; ++y) add_instance(scene, tile, {0.5 * x, 0.5 * y, 0});
  }
}

/// The last instance goes straight on from there.
inline void add_motion(sim::Scene& scene, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& velocity) {
  const int instance = static_cast<int>(scene.instances.size()) - 1;
  scene.motions.push_back(
      {instance, [from, velocity](Stamp stamp) {
         return Pose{Eigen::Quaterniond::Identity(), from + to_seconds(stamp) * velocity};
       }});
}

/// A camera that looks straight down on a point, x to the right.
inline Pose above(double x, double y, double height) {
  return {Eigen::Quaterniond(0, 1, 0, 0), {x, y, height}};
}

/// Uniform light, so that colours equal those of the textures.
inline void light_evenly(sim::Scene& scene) {
  scene.light.sun.setZero();
  scene.light.sky.setOnes();
  scene.light.bounce.setOnes();
}

}  // namespace vinebench::test
