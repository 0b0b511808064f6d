// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/world/rows.h"

namespace vinebench::sim {

/// Spatial index for the distance to the nearest row.
class RowIndex {
 public:
  static constexpr double kReach = 3.0;  ///< m; rows further away are ignored

  explicit RowIndex(const std::vector<RowConfig>& rows);

  /// m, to the nearest row's line, at most kReach.
  double distance(const Eigen::Vector2d& p) const;

 private:
  struct Segment {
    Eigen::Vector2d start, way;
    double distance(const Eigen::Vector2d& p) const;
  };
  std::vector<Segment> rows_;
  Eigen::Vector2d low_;
  int columns_ = 0, lines_ = 0;
  std::vector<std::vector<int>> bins_;  ///< rows within reach of each square, row-major
};

}  // namespace vinebench::sim
