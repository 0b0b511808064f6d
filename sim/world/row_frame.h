// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "sim/world/rows.h"

namespace vinebench::sim {

/// A frame that rows agree on: x along them, y to the left, its origin at the first row's start.
/// Where rows are parallel and evenly spaced, row k lies at y = first + k * spacing.
struct RowFrame {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, world
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< unit, world
  bool regular = false;      ///< rows are parallel and evenly spaced; else the axes are the world's
  double spacing = 2.5;      ///< m between rows
  Eigen::AlignedBox2d rows;  ///< m, of all rows, in this frame

  Eigen::Vector2d across() const { return {-along.y(), along.x()}; }
  double heading() const { return std::atan2(along.y(), along.x()); }
  Eigen::Vector2d from_world(const Eigen::Vector2d& p) const {
    return {(p - origin).dot(along), (p - origin).dot(across())};
  }
  Eigen::Vector2d to_world(const Eigen::Vector2d& p) const {
    return origin + p.x() * along + p.y() * across();
  }
  Eigen::Vector2d middle() const { return to_world(rows.center()); }
};

/// Of these rows; the world's axes where there is none.
RowFrame row_frame(const std::vector<RowConfig>& rows);

}  // namespace vinebench::sim
