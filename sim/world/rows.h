// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/config/config_field.h"

namespace vinebench::sim {

/// Where things may stand, m from the origin.
inline constexpr Range kPlace = Range::between(-5000, 5000);

/// One row of the trellis.
struct RowConfig {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< m; its first post
  Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< m; its last post
  template <class Archive>
  void serialize(Archive& archive) {
    archive("start", start, kPlace);
    archive("end", end, kPlace);
    archive.require((end - start).norm() > 0.1, "end", "expected a row of at least 0.1 m");
  }
};

/// Rows side by side, each `spacing` to the left of the one before.
struct BlockConfig {
  int rows = 1;                                      ///< number of them
  double length = 30;                                ///< m
  double spacing = 2.5;                              ///< m between rows
  double heading_deg = 0;                            ///< from east over north, along the rows
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, start of the first row
  template <class Archive>
  void serialize(Archive& archive) {
    archive("rows", rows, Range::between(1, 500));
    archive("length", length, Range::between(0.1, 2000));
    archive("spacing", spacing, Range::between(0.3, 50));
    archive("heading_deg", heading_deg, Range::between(-360, 360));
    archive("origin", origin, kPlace);
  }
};

}  // namespace vinebench::sim
