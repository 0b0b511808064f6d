// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/occluders/occluder_path.h"

#include <cmath>
#include <numbers>

#include "core/config/validate.h"
#include "core/geometry/angle.h"

namespace vinebench::sim {
namespace {

double heading_of(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

}  // namespace

PathMotion::PathMotion(const OccluderPath& path) : loop_(path.loop) {
  validate(path);
  const std::vector<OccluderPath::Waypoint>& stops = path.waypoints;
  const double rate = path.turn_rate_deg * kRadiansPerDegree;
  const double first = heading_of(stops[1].position - stops[0].position);
  last_ << stops[0].position, first;
  add(stops[0].wait, last_);
  const std::size_t legs = path.loop ? stops.size() : stops.size() - 1;
  for (std::size_t i = 0; i < legs; ++i) {
    const OccluderPath::Waypoint& to = stops[(i + 1) % stops.size()];
    const Eigen::Vector2d way = to.position - stops[i].position;
    if (way.norm() < OccluderPath::kShortestLeg) continue;  // the last waypoint is the first
    turn(heading_of(way), rate);
    const Eigen::Vector3d there(to.position.x(), to.position.y(), last_.z());
    add(way.norm() / to.speed.value_or(path.speed), there);
    if (i + 1 < stops.size()) add(to.wait, last_);
  }
  if (loop_) turn(first, rate);
}

void PathMotion::add(double seconds, const Eigen::Vector3d& to) {
  const Stamp begin = segments_.empty() ? 0 : segments_.back().end;
  segments_.push_back({begin, begin + from_seconds(seconds), last_, to});
  last_ = to;
}

/// The shorter way round.
void PathMotion::turn(double heading, double rate) {
  const double by = std::remainder(heading - last_.z(), 2 * std::numbers::pi);
  add(std::abs(by) / rate, last_ + Eigen::Vector3d(0, 0, by));
}

Eigen::Vector3d PathMotion::at(Stamp stamp) const {
  if (stamp <= 0) return segments_.front().from;
  if (loop_) stamp %= duration();
  for (const Segment& segment : segments_) {
    if (stamp >= segment.end) continue;
    const double share = static_cast<double>(stamp - segment.begin) /
                         static_cast<double>(segment.end - segment.begin);
    return segment.from + share * (segment.to - segment.from);
  }
  return segments_.back().to;
}

}  // namespace vinebench::sim
