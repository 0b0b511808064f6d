// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/world_layout.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"
#include "core/util/error.h"
#include "core/util/random.h"
#include "sim/world/occluder_pose.h"
#include "sim/world/row_frame.h"
#include "sim/world/tag_family.h"

namespace vinebench::sim {
namespace {

/// A tag as surveyed against the tag as it is.
Pose survey_error(const SurveyAccuracy& survey, const RandomStream& stream) {
  Vector6d step;
  for (int i = 0; i < 6; ++i) {
    step[i] =
        (i < 3 ? survey.position : survey.rotation) * stream.normal(static_cast<std::uint64_t>(i));
  }
  return step_of(step);
}

constexpr double kSamePlace = 1e-3;  // m; two posts nearer than this are one

/// Key and problem, as WorldConfig::layout_problem().
using Problem = std::pair<std::string, std::string>;

/// Those of the file, then those of its block.
std::vector<RowConfig> rows_of(const WorldConfig& world) {
  std::vector<RowConfig> rows = world.rows;
  if (!world.block) return rows;
  const BlockConfig& block = *world.block;
  const double heading = block.heading_deg * kRadiansPerDegree;
  const Eigen::Vector2d along(std::cos(heading), std::sin(heading));
  const Eigen::Vector2d across(-along.y(), along.x());
  for (int i = 0; i < block.rows; ++i) {
    const Eigen::Vector2d start = block.origin + i * block.spacing * across;
    rows.push_back({start, start + block.length * along});
  }
  return rows;
}

/// Points from `start` to `end`, the first `offset` from the start, then every `spacing`.
std::vector<Eigen::Vector2d> along(const RowConfig& row, double offset, double spacing) {
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

std::vector<TrellisPost> posts_of(const WorldConfig::Trellis& trellis,
                                  const std::vector<RowConfig>& rows) {
  const double lean = std::tan(trellis.end_lean_deg * kRadiansPerDegree);
  std::vector<TrellisPost> posts;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const RowConfig& row = rows[r];
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

std::vector<VinePlace> vines_of(const VinesConfig& vines, const std::vector<RowConfig>& rows) {
  std::vector<VinePlace> places;
  for (const RowConfig& row : rows) {
    const Eigen::Vector2d direction = row.end - row.start;
    for (const Eigen::Vector2d& foot : along(row, vines.spacing / 2, vines.spacing)) {
      places.push_back({foot, std::atan2(direction.y(), direction.x())});
    }
  }
  return places;
}

/// What makes the world larger than its limits.
Problem size_problem(const WorldConfig& world, const std::vector<RowConfig>& rows) {
  double length = 0;
  for (const RowConfig& row : rows) length += (row.end - row.start).norm();
  if (length > WorldConfig::kMostRow) {
    return {"rows", fmt::format("{:.0f} m of rows in all, expected at most {:.0f} m", length,
                                WorldConfig::kMostRow)};
  }
  if (const double count = length / world.vines.spacing; count > WorldConfig::kMostVines) {
    return {"vines", fmt::format("about {:.0f} places for vines, expected at most {:.0f}: make "
                                 "vines.spacing larger or the rows fewer",
                                 count, WorldConfig::kMostVines)};
  }
  const Terrain terrain(world.terrain, world.ground, rows);
  if (const double area = terrain.box().volume(); area > WorldConfig::kMostGround) {
    return {"rows", fmt::format("the rows lie on {:.0f} m^2 of ground, expected at most {:.0f}",
                                area, WorldConfig::kMostGround)};
  }
  if (const double nodes = terrain.nodes(); nodes > WorldConfig::kMostCells) {
    return {"terrain", fmt::format("{:.1f} million cells of {} m, expected at most {:.1f}: make "
                                   "terrain.cell larger",
                                   nodes / 1e6, world.terrain.cell, WorldConfig::kMostCells / 1e6)};
  }
  return {};
}

/// A tag on a post that is not there.
Problem tag_problem(const WorldConfig& world, const std::vector<RowConfig>& rows) {
  const int count = static_cast<int>(rows.size());
  std::vector<int> posts(rows.size(), 0);
  for (const TrellisPost& post : posts_of(world.trellis, rows)) {
    ++posts[static_cast<std::size_t>(post.row)];
  }
  for (std::size_t i = 0; i < world.tags.size(); ++i) {
    if (!world.tags[i].post) continue;
    const WorldConfig::PostSide& on = *world.tags[i].post;
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

const TrellisPost& post_of(const std::vector<TrellisPost>& posts, const WorldConfig::PostSide& on) {
  const auto first = std::ranges::find(posts, on.row, &TrellisPost::row);
  const auto last =
      std::find_if(first, posts.end(), [&](const TrellisPost& post) { return post.row != on.row; });
  return on.index >= 0 ? *(first + on.index) : *(last + on.index);
}

/// The middle of the print lies off the post by its radius, its lean over half the board, and the
/// board's thickness.
TagPlace hang(const WorldConfig::Tag& tag, const TrellisPost& post, const RowConfig& row) {
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
  TagPlace place;
  place.position << post.at(tag.post->height) + off * facing, tag.post->height;
  place.facing_deg = std::atan2(facing.y(), facing.x()) / kRadiansPerDegree;
  return place;
}

TagPlace place_of(const WorldConfig::Tag& tag, const WorldLayout& layout) {
  if (!tag.post) {
    return {tag.position, tag.facing_deg, layout.terrain.height(tag.position.head<2>())};
  }
  const TrellisPost& post = post_of(layout.posts, *tag.post);
  TagPlace place = hang(tag, post, layout.rows[static_cast<std::size_t>(tag.post->row)]);
  place.ground = layout.terrain.height(post.foot);
  return place;
}

template <class Place>
std::vector<Eigen::Vector2d> feet_of(const std::vector<Place>& places) {
  std::vector<Eigen::Vector2d> feet;
  for (const Place& place : places) feet.push_back(place.foot);
  return feet;
}

}  // namespace

std::pair<std::string, std::string> WorldConfig::layout_problem() const {
  if (!has_sound_rows()) {
    return {"rows", fmt::format("expected at least one row, each of at least {} m", kShortestRow)};
  }
  const std::vector<Row> laid = rows_of(*this);
  if (ground.aisles == Ground::Aisles::kGrass && !row_frame(laid).regular) {
    return {"ground", "grass in the aisles needs rows that are parallel and evenly spaced"};
  }
  const Problem size = size_problem(*this, laid);
  return size.second.empty() ? sim::tag_problem(*this, laid) : size;
}

std::vector<Eigen::Vector2d> WorldLayout::post_feet() const {
  return feet_of(posts);
}

std::vector<Eigen::Vector2d> WorldLayout::vine_feet() const {
  return feet_of(vines);
}

void check_layout(const WorldConfig& world) {
  if (const auto [key, problem] = world.layout_problem(); !problem.empty()) {
    fail("world {}: {}: {}", world.name, key, problem);
  }
}

WorldLayout lay_out(const WorldConfig& world) {
  check_layout(world);
  const std::vector<RowConfig> rows = rows_of(world);
  WorldLayout layout{.rows = rows,
                     .terrain = Terrain(world.terrain, world.ground, rows),
                     .posts = posts_of(world.trellis, rows),
                     .vines = vines_of(world.vines, rows),
                     .tags = {},
                     .occluders = {}};
  for (const WorldConfig::Tag& tag : world.tags) layout.tags.push_back(place_of(tag, layout));
  for (const Occluder& occluder : world.occluders) {
    layout.occluders.push_back(occluder_pose(occluder, layout.terrain));
  }
  return layout;
}

WorldConfig written_out(WorldConfig world) {
  const WorldLayout layout = lay_out(world);
  world.block.reset();
  world.rows = layout.rows;
  for (std::size_t i = 0; i < world.tags.size(); ++i) {
    world.tags[i].position = layout.tags[i].position;
    world.tags[i].facing_deg = layout.tags[i].facing_deg;
  }
  return world;
}

Pose tag_pose(const TagPlace& place) {
  const double facing = place.facing_deg * kRadiansPerDegree;
  const Eigen::Vector3d into(-std::cos(facing), -std::sin(facing), 0);
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d axes;
  axes << down.cross(into), down, into;
  return {Eigen::Quaterniond(axes).normalized(),
          place.position + place.ground * Eigen::Vector3d::UnitZ()};
}

std::vector<WorldTag> world_tags(const WorldConfig& world) {
  const WorldLayout layout = lay_out(world);
  std::vector<WorldTag> tags;
  for (std::size_t i = 0; i < world.tags.size(); ++i) {
    const WorldConfig::Tag& tag = world.tags[i];
    tags.push_back({tag.family, tag.id, tag.size, tag_pose(layout.tags[i]), tag.registered});
  }
  return tags;
}

std::vector<RegisteredTag> registered_tags(const WorldConfig& world, std::uint64_t seed) {
  const WorldLayout layout = lay_out(world);
  const SurveyAccuracy survey{world.survey.position, world.survey.rotation_deg * kRadiansPerDegree};
  std::vector<RegisteredTag> tags;
  for (std::size_t i = 0; i < world.tags.size(); ++i) {
    const WorldConfig::Tag& tag = world.tags[i];
    if (!tag.registered) continue;
    TagPlace surveyed = layout.tags[i];
    surveyed.position += tag.survey_error.offset;
    surveyed.facing_deg += tag.survey_error.turn_deg;
    tags.push_back({tag.family, tag.id, tag.size, tag_pose(surveyed), survey});
    if (survey.position == 0 && survey.rotation == 0) continue;
    Pose& told = tags.back().T_world_tag;
    told = told * survey_error(survey, RandomStream(seed, "survey", i));
  }
  return tags;
}

Site site_of(const WorldConfig& world) {
  const WorldLayout layout = lay_out(world);
  Site site;
  site.name = world.name;
  for (const RowConfig& row : layout.rows) site.rows.push_back({row.start, row.end});
  site.vines = layout.vine_feet();
  site.posts = layout.post_feet();
  for (std::size_t i = 0; i < world.occluders.size(); ++i) {
    const Occluder& occluder = world.occluders[i];
    const Eigen::Vector2d centre = layout.occluders[i].translation.head<2>();
    const double yaw =
        occluder.path ? yaw_of(layout.occluders[i].rotation) / kRadiansPerDegree : occluder.yaw_deg;
    const Eigen::Vector3d size = size_of(occluder);
    site.objects.push_back({class_of(occluder), centre, size.head<2>(), yaw, colour_of(occluder),
                            occluder.path.has_value(), layout.occluders[i].translation.z(),
                            size.z()});
  }
  site.tags = world_tags(world);
  site.vine_spacing = world.vines.spacing;
  site.canopy_depth = world.vines.canopy_depth;
  site.canopy_foot = world.vines.lowest_bunch;
  site.canopy_top = world.vines.canopy_top;
  site.post_radius = world.trellis.post_radius;
  site.post_height = world.trellis.post_height;
  return site;
}

}  // namespace vinebench::sim
