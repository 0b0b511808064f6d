// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace vinebench::sim {

/// Normals of a mesh that has none.
struct CornerNormals {
  std::vector<Eigen::Vector3f> normals;  ///< unit; zero where all triangles are degenerate
  std::vector<std::uint32_t> of_corner;  ///< index into normals, three for each triangle
};

/// At each position, the triangles whose normals are within `sharpest` (rad) of the first of them
/// share their mean, weighted by their angles there; the others keep an edge. `position` gives that
/// of a corner; corners at one position need not be one vertex.
CornerNormals smooth_normals(std::size_t corners,
                             const std::function<Eigen::Vector3f(std::size_t)>& position,
                             float sharpest);

}  // namespace vinebench::sim
