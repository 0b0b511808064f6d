// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/block_mesh.h"

#include <cmath>

namespace vinebench::sim {

using Eigen::Vector3f;

Vector3f linear_colour(const Eigen::Vector3d& srgb) {
  const auto linear = [](double c) {
    return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  };
  return {linear(srgb.x()), linear(srgb.y()), linear(srgb.z())};
}

void add_face(MeshBuilder& builder, const Vector3f& middle, const Vector3f& right,
              const Vector3f& up, const TextureCell& cell, float foot_occlusion) {
  const Vector3f normal = right.cross(up).normalized();
  const auto a = builder.vertex(middle - right - up, normal, cell.at(0, 1), foot_occlusion);
  const auto b = builder.vertex(middle + right - up, normal, cell.at(1, 1), foot_occlusion);
  const auto c = builder.vertex(middle + right + up, normal, cell.at(1, 0));
  const auto d = builder.vertex(middle - right + up, normal, cell.at(0, 0));
  builder.quad(a, b, c, d);
}

void add_block(MeshBuilder& builder, const Vector3f& centre, const Vector3f& half,
               float foot_occlusion) {
  const Vector3f x = half.x() * Vector3f::UnitX(), y = half.y() * Vector3f::UnitY();
  const Vector3f z = half.z() * Vector3f::UnitZ();
  const TextureCell cell;
  add_face(builder, centre + x, y, z, cell, foot_occlusion);
  add_face(builder, centre - x, -y, z, cell, foot_occlusion);
  add_face(builder, centre - y, x, z, cell, foot_occlusion);
  add_face(builder, centre + y, -x, z, cell, foot_occlusion);
  add_face(builder, centre + z, -y, x, cell);
  add_face(builder, centre - z, y, x, cell, foot_occlusion);
}

}  // namespace vinebench::sim
