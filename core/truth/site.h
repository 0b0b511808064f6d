// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "core/truth/occlusion.h"

namespace vinebench {

/// An AprilTag of the world at its true pose.
struct WorldTag {
  std::string family;
  int id = 0;
  double size = 0;         ///< m, side of the black square
  Pose T_world_tag;        ///< tag frame: x right, y down on the printed face, z into the tag
  bool registered = true;  ///< whether the SLAM system is given its pose
};

/// What stands in a vineyard, for evaluation, plots, reports and data sets. Empty if a source has
/// none, such as a recording of others.
struct Site {
  struct Row {
    Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< m
    Eigen::Vector2d end = Eigen::Vector2d::Zero();    ///< m
  };
  /// An occluder.
  struct Object {
    OccluderClass kind = OccluderClass::kCarton;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< m
    Eigen::Vector2d size = Eigen::Vector2d::Zero();    ///< m, along its own x and y
    double yaw_deg = 0;
    Eigen::Vector3d colour = Eigen::Vector3d::Zero();  ///< sRGB, 0 to 1
    bool moves = false;                                ///< along a path that begins there
    double foot = 0;                                   ///< m, world; z of its lowest point
    double height = 0;                                 ///< m
  };
  std::string name;  ///< of the world
  std::vector<Row> rows;
  std::vector<Eigen::Vector2d> vines;  ///< m, positions on the ground
  std::vector<Eigen::Vector2d> posts;  ///< m, positions on the ground
  std::vector<Object> objects;
  std::vector<WorldTag> tags;  ///< in the order of the indices in Truth::visible_tags
  double vine_spacing = 0;     ///< m, along a row
  double canopy_depth = 0;     ///< m, across a row
  double canopy_foot = 0;      ///< m above the ground
  double canopy_top = 0;       ///< m above the ground
  double post_radius = 0;      ///< m
  double post_height = 0;      ///< m
};

}  // namespace vinebench
