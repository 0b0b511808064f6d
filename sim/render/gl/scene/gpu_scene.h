// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "sim/render/gl/platform/gl_objects.h"
#include "sim/scene/scene.h"

namespace vinebench::sim {

/// Directions, in the model's frame, along which a primitive's triangles are kept sorted, so that
/// those towards the camera can be drawn first: +x, -x, +y, -y.
inline constexpr int kDrawOrders = 4;

/// The order for a camera in that direction from the model.
int draw_order(const Eigen::Vector3d& towards_camera);

/// The indices sorted such that triangles further along each of the directions come first: one list
/// after the other. Coarsely, so that neighbours stay neighbours.
std::vector<std::uint32_t> sorted_indices(const Primitive& primitive);

/// Where a primitive lies in the scene's one buffer of vertices and one of indices.
struct GpuPrimitive {
  int material = 0;
  GLint first_vertex = 0;
  std::size_t first_index = 0;
  GLsizei count = 0;  ///< indices of one draw order
};

struct GpuLevel {
  double until = 0;  ///< m, for kLevelFocalLength
  std::vector<GpuPrimitive> primitives;
};

struct GpuModel {
  std::vector<GpuLevel> levels;
  Eigen::AlignedBox3f bounds;  ///< of all levels
  double hollow = 0;           ///< m, free of vertices around the bounds' vertical axis
  bool casts_shadow = false;   ///< ground and grass do not
  bool ordered = false;        ///< large enough for its triangles' order to matter
};

/// A thing in its place, and a ball around it for a first guess at whether it is in view.
struct GpuInstance {
  int model = 0;
  Eigen::Matrix4d world_from_model;
  Eigen::Matrix4d model_from_world;
  double scale = 1;
  Eigen::Vector3d centre;  ///< m, world frame
  double radius = 0;       ///< m
  bool moves = false;      ///< it stands elsewhere at other times
  bool open = false;       ///< no shadow of what stands still can fall on it
};

/// `scale` is the instance's.
GpuInstance place(int model_index, const GpuModel& model, const Pose& T_world_model, double scale);

/// The wires of a few metres of vineyard, which are in view together.
struct WireChunk {
  Eigen::Vector3d centre;  ///< m, world frame
  double reach = 0;        ///< m, radius of a ball around them
  double thickest = 0;     ///< m, radius of the thickest wire
  GLint first = 0;
  GLsizei count = 0;  ///< vertices
};

/// Wires in pieces short enough that a strip's width can be interpolated along each.
struct GpuWires {
  int material = 0;
  std::vector<WireChunk> chunks;
  GlVertexArray array;
  GlBuffer vertices;
};

/// What moves, where it is at an instant.
struct Mover {
  std::size_t index = 0;  ///< among the scene's instances; their number for the rover
  Pose T_world_model;
  GpuInstance placed;  ///< there
  /// m, the model's frame: points whose hull has all of it inside.
  const std::vector<Eigen::Vector3d>* hull = nullptr;

  Eigen::Vector3d in_world(const Eigen::Vector3d& p) const {
    return T_world_model * (placed.scale * p);
  }
};

/// What the shaders read of an instance: one row of its matrix after the other, and its number.
struct InstanceRow {
  Eigen::Matrix<float, 3, 4, Eigen::RowMajor> matrix;
  std::uint32_t number = 0;  ///< its index among the scene's instances plus one
};

/// What of a scene lives in the GL context, and what is still needed to draw it. Throws Error when
/// the scene refers to something that it has not.
struct GpuScene {
  GpuScene(const GlFunctions& functions, const Scene& scene);

  /// Puts the rows where the shaders read instances from.
  void set_instances(const std::vector<InstanceRow>& rows) const;
  /// Draws `count` of the rows from `first` on, in that order of triangles.
  void draw(const GpuPrimitive& primitive, int order, std::size_t first, std::size_t count) const;
  /// Everything that moves at a time, s, and the rover where it is there.
  std::vector<Mover> movers(double time, const std::optional<Pose>& T_world_rover) const;

  const GlFunctions& gl;  ///< of the context that the scene lives in
  std::vector<GlTexture> textures;
  std::vector<Material> materials;
  std::vector<GpuModel> models;
  std::vector<GpuInstance> instances;
  int rover_model = -1;
  std::vector<GpuWires> wires;
  Light light;
  Wind wind;

 private:
  /// An instance that moves, and the hull of its model.
  struct Moving {
    Motion motion;
    std::vector<Eigen::Vector3d> hull;
  };
  std::vector<Moving> moving_;
  std::vector<Eigen::Vector3d> rover_hull_;
  GlVertexArray array_;
  GlBuffer vertices_;
  GlBuffer indices_;
  GlBuffer rows_;
};

}  // namespace vinebench::sim
