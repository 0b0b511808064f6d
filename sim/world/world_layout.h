// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/pose.h"
#include "core/slam_system.h"
#include "core/truth/site.h"
#include "sim/world/terrain.h"
#include "sim/world/world.h"

namespace vinebench::sim {

/// A post as it stands.
struct TrellisPost {
  Eigen::Vector2d foot;  ///< m
  Eigen::Vector2d lean;  ///< m of its head outward for each m of height
  double radius = 0;     ///< m
  int row = 0;
  int index = 0;  ///< along its row
  bool end = false;
  Eigen::Vector2d at(double height) const { return foot + height * lean; }
};

/// A vine's place; vine_at() tells whether it is empty.
struct VinePlace {
  Eigen::Vector2d foot;  ///< m
  double heading = 0;    ///< rad, of its row
};

/// Where a tag hangs.
struct TagPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, its centre; z above the ground
  double facing_deg = 0;                               ///< heading of the printed face
  double ground = 0;                                   ///< m, height of the ground below
};

/// Tag frame: x right and y down on the printed face, z into the tag.
Pose tag_pose(const TagPlace& place);

/// Where everything of a world stands that its file describes in relation to something else.
struct WorldLayout {
  std::vector<RowConfig> rows;     ///< those of the file, then those of its block
  Terrain terrain;                 ///< the surface of the ground
  std::vector<TrellisPost> posts;  ///< row by row, from each row's start
  std::vector<VinePlace> vines;    ///< row by row
  std::vector<TagPlace> tags;      ///< in the order of the file
  std::vector<Pose> occluders;     ///< their frames in the world, in the order of the file

  std::vector<Eigen::Vector2d> post_feet() const;  ///< m
  std::vector<Eigen::Vector2d> vine_feet() const;  ///< m
};

/// Throws Error that names the key at fault where the world has a layout_problem().
void check_layout(const WorldConfig& world);

/// The layout; check_layout() comes first.
WorldLayout lay_out(const WorldConfig& world);

/// The same world without relations: rows in place of a block, and the places of tags on posts.
/// Its layout is that of `world`.
WorldConfig written_out(WorldConfig world);

/// The tags whose pose the SLAM system is told, with the errors of their survey, of which the seed
/// draws those that WorldConfig::survey has.
std::vector<RegisteredTag> registered_tags(const WorldConfig& world, std::uint64_t seed);

/// All tags as they truly stand, in the order of the file.
std::vector<WorldTag> world_tags(const WorldConfig& world);

/// The world seen from above.
Site site_of(const WorldConfig& world);

}  // namespace vinebench::sim
