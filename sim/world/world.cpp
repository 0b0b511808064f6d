// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/util/error.h"
#include "core/util/random.h"
#include "sim/world/row_frame.h"
#include "sim/world/tag_family.h"
#include "sim/world/terrain.h"

namespace vinebench::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kShortestRow = 0.1;  // m
constexpr double kSamePlace = 1e-3;   // m; two posts nearer than this are one

/// Points from `start` to `end`, the first `offset` from the start, then every `spacing`.
std::vector<Eigen::Vector2d> along(const WorldConfig::Row& row, double offset, double spacing) {
  const double length = (row.end - row.start).norm();
  const Eigen::Vector2d direction = (row.end - row.start) / length;
  std::vector<Eigen::Vector2d> points;
  for (int i = 0;; ++i) {
    const double at = offset + i * spacing;
    if (at > length - offset + kSamePlace) break;
    points.push_back(row.start + at * direction);
  }
  return points;
}

const TrellisPost& post_of(const std::vector<TrellisPost>& posts, const WorldConfig::PostSide& on) {
  const auto first = std::ranges::find(posts, on.row, &TrellisPost::row);
  const auto last =
      std::find_if(first, posts.end(), [&](const TrellisPost& post) { return post.row != on.row; });
  return on.index >= 0 ? *(first + on.index) : *(last + on.index);
}

/// The middle of the print lies off the post by its radius, its lean over half the board, and the
/// board's thickness.
void hang(WorldConfig::Tag& tag, const TrellisPost& post, const WorldConfig::Row& row) {
  using Side = WorldConfig::PostSide::Side;
  const Eigen::Vector2d along = (row.end - row.start).normalized();
  const Eigen::Vector2d left(-along.y(), along.x());
  Eigen::Vector2d facing = left;
  if (tag.post->side == Side::kRight) facing = -left;
  if (tag.post->side == Side::kStart) facing = -along;
  if (tag.post->side == Side::kEnd) facing = along;
  const double half_board = tag.size * tag_board_scale(tag.family) / 2;
  const double off = post.radius * std::sqrt(1 + post.lean.squaredNorm()) +
                     half_board * std::abs(facing.dot(post.lean)) + kTagBoardThickness;
  tag.position << post.at(tag.post->height) + off * facing, tag.post->height;
  tag.facing_deg = std::atan2(facing.y(), facing.x()) / kRadians;
}

}  // namespace

std::string WorldConfig::tag_problem(const std::string& family, int id) {
  if (!TagFamily::known(family)) {
    std::string names;
    for (const std::string& name : TagFamily::names()) names += (names.empty() ? "" : ", ") + name;
    return fmt::format("expected a family of {}, found {}", names, family);
  }
  const int size = TagFamily(family).size();
  if (id >= 0 && id < size) return "";
  return fmt::format("expected 0 to {} for {}, found {}", size - 1, family, id);
}

bool WorldConfig::has_sound_rows() const {
  return (block || !rows.empty()) && std::ranges::all_of(rows, [](const Row& row) {
           return (row.end - row.start).norm() > kShortestRow;
         });
}

std::pair<std::string, std::string> WorldConfig::placing_problem() const {
  if (!has_sound_rows()) {
    return {"rows", fmt::format("expected at least one row, each of at least {} m", kShortestRow)};
  }
  if (ground.aisles == Ground::Aisles::kGrass && !block && !row_frame(rows).regular) {
    return {"ground", "grass in the aisles needs rows that are parallel and evenly spaced"};
  }
  const int count = static_cast<int>(rows.size()) + (block ? block->rows : 0);
  WorldConfig laid = *this;
  laid.expand_block();
  if (const auto [key, problem] = laid.size_problem(); !problem.empty()) return {key, problem};
  std::vector<int> posts(static_cast<std::size_t>(count), 0);
  for (const TrellisPost& post : trellis_posts(laid)) ++posts[static_cast<std::size_t>(post.row)];
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (!tags[i].post) continue;
    const PostSide& on = *tags[i].post;
    const std::string key = fmt::format("tags.{}.post", i);
    if (on.row >= count) {
      return {key, fmt::format("expected a row from 0 to {}, found {}", count - 1, on.row)};
    }
    const int of_row = posts[static_cast<std::size_t>(on.row)];
    if (on.index >= of_row || on.index < -of_row) {
      return {key, fmt::format("expected an index from {} to {} in row {}, found {}", -of_row,
                               of_row - 1, on.row, on.index)};
    }
  }
  return {};
}

std::pair<std::string, std::string> WorldConfig::size_problem() const {
  double row = 0;
  for (const Row& r : rows) row += (r.end - r.start).norm();
  if (row > kMostRow) {
    return {"rows",
            fmt::format("{:.0f} m of rows in all, expected at most {:.0f} m", row, kMostRow)};
  }
  if (const double count = row / vines.spacing; count > kMostVines) {
    return {"vines", fmt::format("about {:.0f} places for vines, expected at most {:.0f}: make "
                                 "vines.spacing larger or the rows fewer",
                                 count, kMostVines)};
  }
  const sim::Terrain ground_now = terrain_of(*this);
  if (const double area = ground_now.box().volume(); area > kMostGround) {
    return {"rows", fmt::format("the rows lie on {:.0f} m^2 of ground, expected at most {:.0f}",
                                area, kMostGround)};
  }
  if (const double nodes = ground_now.nodes(); nodes > kMostCells) {
    return {"terrain", fmt::format("{:.1f} million cells of {} m, expected at most {:.1f}: make "
                                   "terrain.cell larger",
                                   nodes / 1e6, terrain.cell, kMostCells / 1e6)};
  }
  return {};
}

void WorldConfig::expand_block() {
  if (!block) return;
  const double heading = block->heading_deg * kRadians;
  const Eigen::Vector2d along(std::cos(heading), std::sin(heading));
  const Eigen::Vector2d across(-along.y(), along.x());
  for (int i = 0; i < block->rows; ++i) {
    const Eigen::Vector2d start = block->origin + i * block->spacing * across;
    rows.push_back({start, start + block->length * along});
  }
  block.reset();
}

void WorldConfig::place() {
  if (const auto [key, problem] = placing_problem(); !problem.empty()) {
    fail("world {}: {}: {}", name, key, problem);
  }
  expand_block();
  const sim::Terrain terrain_now = terrain_of(*this);
  const std::vector<TrellisPost> posts = trellis_posts(*this);
  for (Tag& tag : tags) {
    Eigen::Vector2d foot = tag.position.head<2>();
    if (tag.post) {
      const TrellisPost& post = post_of(posts, *tag.post);
      hang(tag, post, rows[static_cast<std::size_t>(tag.post->row)]);
      foot = post.foot;
    }
    tag.ground = terrain_now.height(foot);
  }
}

std::vector<TrellisPost> trellis_posts(const WorldConfig& world) {
  const WorldConfig::Trellis& trellis = world.trellis;
  const double lean = std::tan(trellis.end_lean_deg * kRadians);
  std::vector<TrellisPost> posts;
  for (std::size_t r = 0; r < world.rows.size(); ++r) {
    const WorldConfig::Row& row = world.rows[r];
    std::vector<Eigen::Vector2d> feet = along(row, 0, trellis.post_spacing);
    // The last span is merged with its neighbour where it would be very short.
    if (feet.size() > 1 && (feet.back() - row.end).norm() < 0.25 * trellis.post_spacing) {
      feet.pop_back();
    }
    feet.push_back(row.end);
    const Eigen::Vector2d outward = lean * (row.end - row.start).normalized();
    for (std::size_t i = 0; i < feet.size(); ++i) {
      const bool first = i == 0, last = i + 1 == feet.size(), end = first || last;
      const Eigen::Vector2d leaned =
          first ? Eigen::Vector2d(-outward) : (last ? outward : Eigen::Vector2d(0, 0));
      posts.push_back({feet[i], leaned, end ? trellis.end_post_radius : trellis.post_radius,
                       static_cast<int>(r), static_cast<int>(i), end});
    }
  }
  return posts;
}

std::vector<Eigen::Vector2d> post_positions(const WorldConfig& world) {
  std::vector<Eigen::Vector2d> feet;
  for (const TrellisPost& post : trellis_posts(world)) feet.push_back(post.foot);
  return feet;
}

std::vector<VinePlace> vine_places(const WorldConfig& world) {
  std::vector<VinePlace> vines;
  for (const WorldConfig::Row& row : world.rows) {
    const Eigen::Vector2d way = row.end - row.start;
    for (const Eigen::Vector2d& foot : along(row, world.vines.spacing / 2, world.vines.spacing)) {
      vines.push_back({foot, std::atan2(way.y(), way.x())});
    }
  }
  return vines;
}

std::vector<Eigen::Vector2d> vine_positions(const WorldConfig& world) {
  std::vector<Eigen::Vector2d> feet;
  for (const VinePlace& vine : vine_places(world)) feet.push_back(vine.foot);
  return feet;
}

VineKind vine_at(const WorldConfig& world, std::uint64_t seed, std::size_t place) {
  const double draw = RandomStream(seed, "vine gaps").uniform(place);
  if (draw < world.vines.missing) return VineKind::kNone;
  return draw < world.vines.missing + world.vines.young ? VineKind::kYoung : VineKind::kGrown;
}

Pose tag_pose(const WorldConfig::Tag& tag) {
  const double facing = tag.facing_deg * kRadians;
  const Eigen::Vector3d into(-std::cos(facing), -std::sin(facing), 0);
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d axes;
  axes << down.cross(into), down, into;
  return {Eigen::Quaterniond(axes).normalized(),
          tag.position + tag.ground * Eigen::Vector3d::UnitZ()};
}

Terrain terrain_of(const WorldConfig& world) {
  return Terrain(world.terrain, world.ground, world.rows);
}

std::vector<WorldTag> world_tags(const WorldConfig& world) {
  std::vector<WorldTag> tags;
  for (const WorldConfig::Tag& tag : world.tags) {
    tags.push_back({tag.family, tag.id, tag.size, tag_pose(tag), tag.registered});
  }
  return tags;
}

Site site_of(const WorldConfig& world) {
  Site site;
  site.name = world.name;
  for (const WorldConfig::Row& row : world.rows) site.rows.push_back({row.start, row.end});
  site.vines = vine_positions(world);
  site.posts = post_positions(world);
  for (const Occluder& occluder : world.occluders) {
    site.objects.push_back({class_of(occluder), occluder.position, size_of(occluder).head<2>(),
                            occluder.yaw_deg, colour_of(occluder)});
  }
  site.tags = world_tags(world);
  site.vine_spacing = world.vines.spacing;
  site.canopy_depth = world.vines.canopy_depth;
  site.post_radius = world.trellis.post_radius;
  return site;
}

std::vector<RegisteredTag> registered_tags(const WorldConfig& world) {
  std::vector<RegisteredTag> tags;
  for (const WorldConfig::Tag& tag : world.tags) {
    if (!tag.registered) continue;
    WorldConfig::Tag surveyed = tag;
    surveyed.position += tag.survey_error.offset;
    surveyed.facing_deg += tag.survey_error.turn_deg;
    tags.push_back({tag.family, tag.id, tag.size, tag_pose(surveyed)});
  }
  return tags;
}

}  // namespace vinebench::sim
