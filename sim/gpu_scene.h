// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "sim/gl_objects.h"
#include "sim/scene.h"

namespace vinebench {

/// Directions, in the model's frame, along which a primitive's triangles are kept sorted, so that
/// those towards the camera can be drawn first: +x, -x, +y, -y.
inline constexpr int kDrawOrders = 4;

/// The order for a camera in that direction from the model.
int draw_order(const Eigen::Vector3d& towards_camera);

/// The indices sorted such that triangles further along each of the directions come first: one list
/// after the other. Coarsely, so that neighbours stay neighbours.
std::vector<std::uint32_t> sorted_indices(const Primitive& primitive);

struct GpuPrimitive {
  int material = 0;
  GlVertexArray array;
  GlBuffer vertices;
  GlBuffer indices;
  GLsizei count = 0;  ///< indices of one draw order
};

struct GpuLevel {
  double until = 0;  ///< m
  std::vector<GpuPrimitive> primitives;
};

struct GpuModel {
  GpuModel() = default;
  GpuModel(GpuModel&&) noexcept = default;
  GpuModel& operator=(GpuModel&&) noexcept = default;

  std::vector<GpuLevel> levels;
  Eigen::AlignedBox3f bounds;  ///< of all levels
  bool casts_shadow = false;   ///< ground and grass do not
};

/// Wires in pieces short enough that a strip's width can be interpolated along each.
struct GpuWires {
  int material = 0;
  GlVertexArray array;
  GlBuffer vertices;
  GLsizei count = 0;
};

/// One row of an instance's matrix after the other, as the shaders read it.
using InstanceMatrix = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;

/// What of a scene lives in the GL context, and what is still needed to draw it. Throws Error when
/// the scene refers to something that it has not.
struct GpuScene {
  explicit GpuScene(const Scene& scene);

  std::vector<GlTexture> textures;
  std::vector<Material> materials;
  std::vector<GpuModel> models;
  std::vector<Instance> instances;
  std::vector<GpuWires> wires;
  Light light;
};

/// The model's matrix in the world, its scale included.
Eigen::Matrix4d world_from_model(const Instance& instance);

/// Points the bound array's instance attributes at the bound buffer, from that instance on.
void bind_instances(std::size_t first);

}  // namespace vinebench
