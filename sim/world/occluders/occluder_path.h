// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/config/config_field.h"
#include "core/time.h"

namespace vinebench::sim {

/// The path of an occluder that moves. It goes straight from waypoint to waypoint at constant
/// speed, looks where it goes, and turns on the spot at each waypoint.
struct OccluderPath {
  struct Waypoint {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, world
    std::optional<double> speed{};  ///< m/s on the leg to this waypoint; the path's if absent
    double wait = 0;                ///< s to wait here
    template <class Archive>
    void serialize(Archive& archive) {
      archive("position", position, Range::between(-5000, 5000));
      archive("speed", speed, Range::between(0.01, 20));
      archive("wait", wait, Range::non_negative());
    }
  };
  double speed = 1.0;          ///< m/s
  double turn_rate_deg = 180;  ///< deg/s, at the waypoints
  bool loop = false;           ///< from the last waypoint back to the first, and again
  std::vector<Waypoint> waypoints;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("speed", speed, Range::between(0.01, 20));
    archive("turn_rate_deg", turn_rate_deg, Range::between(1, 3600));
    archive("loop", loop);
    archive("waypoints", waypoints);
    archive.require(waypoints.size() > 1, "waypoints", "expected at least two waypoints");
    for (std::size_t i = 1; i < waypoints.size(); ++i) {
      const double apart = (waypoints[i].position - waypoints[i - 1].position).norm();
      archive.require(apart >= kShortestLeg, "waypoints", "expected neighbours 1 cm or more apart");
    }
  }
  static constexpr double kShortestLeg = 0.01;  ///< m
};

/// The path as a function of time.
class PathMotion {
 public:
  explicit PathMotion(const OccluderPath& path);

  /// x, y (m) and heading (rad), world. Before t = 0 it stands at the first waypoint; after the end
  /// at the last one, unless it loops.
  Eigen::Vector3d at(Stamp stamp) const;

  /// Of one round where it loops, else from the first waypoint to the last.
  Stamp duration() const { return segments_.back().end; }

 private:
  /// Standing, turning or going: linear in time.
  struct Segment {
    Stamp begin = 0;
    Stamp end = 0;
    Eigen::Vector3d from;
    Eigen::Vector3d to;
  };
  void add(double seconds, const Eigen::Vector3d& to);
  void turn(double heading, double rate);

  bool loop_;
  Eigen::Vector3d last_;  ///< where the segments so far end
  std::vector<Segment> segments_;
};

}  // namespace vinebench::sim
