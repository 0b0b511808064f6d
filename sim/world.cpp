// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world.h"

#include <cmath>
#include <numbers>

#include "sim/tag_family.h"

namespace vinebench {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kSamePlace = 1e-3;  // m; two posts nearer than this are one

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

std::vector<Eigen::Vector2d> post_positions(const WorldConfig& world) {
  std::vector<Eigen::Vector2d> posts;
  for (const WorldConfig::Row& row : world.rows) {
    std::vector<Eigen::Vector2d> of_row = along(row, 0, world.trellis.post_spacing);
    // The last span is merged with its neighbour where it would be very short.
    if (of_row.size() > 1 && (of_row.back() - row.end).norm() < 0.25 * world.trellis.post_spacing) {
      of_row.pop_back();
    }
    of_row.push_back(row.end);
    posts.insert(posts.end(), of_row.begin(), of_row.end());
  }
  return posts;
}

std::vector<Eigen::Vector2d> vine_positions(const WorldConfig& world) {
  std::vector<Eigen::Vector2d> vines;
  for (const WorldConfig::Row& row : world.rows) {
    const auto of_row = along(row, world.vines.spacing / 2, world.vines.spacing);
    vines.insert(vines.end(), of_row.begin(), of_row.end());
  }
  return vines;
}

Pose tag_pose(const WorldConfig::Tag& tag) {
  const double facing = tag.facing_deg * kRadians;
  const Eigen::Vector3d into(-std::cos(facing), -std::sin(facing), 0);
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d axes;
  axes << down.cross(into), down, into;
  return {Eigen::Quaterniond(axes).normalized(), tag.position};
}

Pose box_pose(const WorldConfig::Box& box) {
  const Eigen::Vector3d centre(box.position.x(), box.position.y(), box.size.z() / 2);
  return {from_roll_pitch_yaw({0, 0, box.yaw_deg * kRadians}), centre};
}

std::vector<RegisteredTag> registered_tags(const WorldConfig& world) {
  std::vector<RegisteredTag> tags;
  for (const WorldConfig::Tag& tag : world.tags) {
    if (tag.registered) tags.push_back({tag.family, tag.id, tag.size, tag_pose(tag)});
  }
  return tags;
}

}  // namespace vinebench
