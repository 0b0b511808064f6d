// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/render_case.h"

#include <cmath>
#include <numbers>

#include "sim/world/terrain.h"

namespace vinebench::harness {
namespace {

constexpr double kBeside = 1.0;     // m from a single row
constexpr double kHalfTrack = 0.2;  // m, half of the rover's track

}  // namespace

std::vector<Pose> aisle_route(const sim::WorldConfig& world, int count) {
  sim::WorldConfig placed = world;
  if (placed.block) placed.place();
  const std::size_t middle = placed.rows.size() / 2;
  const sim::WorldConfig::Row& last = placed.rows.at(middle);
  sim::WorldConfig::Row first = placed.rows.at(middle == 0 ? 0 : middle - 1);
  const Eigen::Vector2d direction = (last.end - last.start).normalized();
  if ((first.end - first.start).dot(direction) < 0) std::swap(first.start, first.end);
  Eigen::Vector2d start = (first.start + last.start) / 2;
  const Eigen::Vector2d along = (first.end + last.end) / 2 - start;
  if (middle == 0) start += kBeside * Eigen::Vector2d(direction.y(), -direction.x());
  const double heading = std::atan2(along.y(), along.x());
  const sim::Terrain terrain = sim::terrain_of(placed);
  std::vector<Pose> route;
  for (int i = 0; i < count; ++i) {
    const double yaw = heading + (i % 2 == 1 ? std::numbers::pi : 0);
    route.push_back(terrain.lie(start + along * ((i + 0.5) / count), yaw, kHalfTrack));
  }
  return route;
}

}  // namespace vinebench::harness
