// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/base/pose.h"
#include "slam/base/time.h"
#include "slam/base/yaml.h"

namespace vinebench {

/// Where the rover goes. It is omnidirectional: position and heading are independent.
struct RouteConfig {
  struct Waypoint {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, world
    double heading_deg = 0;       ///< accumulated: 360 more is one more turn to the left
    std::optional<double> speed;  ///< m/s on the way here; the route's where absent
    double wait = 0;              ///< s to stand here
    bool pass = false;            ///< drive through without stopping
    template <class Archive>
    void serialize(Archive& archive) {
      archive("position", position);
      archive("heading_deg", heading_deg);
      archive("speed", speed, Range::positive());
      archive("wait", wait, Range::non_negative());
      archive("pass", pass);
    }
  };
  double speed = 0.3;                  ///< m/s
  double turn_rate_deg = 45;           ///< deg/s
  double acceleration = 0.5;           ///< m/s^2
  double turn_acceleration_deg = 120;  ///< deg/s^2
  std::vector<Waypoint> waypoints;     ///< the first is where the rover starts
  template <class Archive>
  void serialize(Archive& archive) {
    archive("speed", speed, Range::positive());
    archive("turn_rate_deg", turn_rate_deg, Range::positive());
    archive("acceleration", acceleration, Range::positive());
    archive("turn_acceleration_deg", turn_acceleration_deg, Range::positive());
    archive("waypoints", waypoints);
    archive.require(!waypoints.empty(), "waypoints", "expected at least one waypoint");
  }
};

/// The route as a function of time: where the body should be.
class Route {
 public:
  explicit Route(const RouteConfig& config);

  struct Reference {
    Eigen::Vector3d pose;      ///< x, y (m), accumulated heading (rad), world
    Eigen::Vector3d velocity;  ///< of these, per s
  };
  Reference at(Stamp stamp) const;
  Stamp duration() const;
  Eigen::Vector3d start() const { return at(0).pose; }
  double length() const;  ///< m, of the way of the body's centre

 private:
  struct Leg {
    Stamp begin = 0;
    Stamp end = 0;
    Eigen::Vector3d from;
    Eigen::Vector3d to;
    double speed_in = 0, speed_out = 0, cruise = 0, acceleration = 0, length = 0;
  };
  std::vector<Leg> legs_;
};

/// Position loop: the body twist (forward, left in m/s, turn in rad/s) that brings the body from
/// where it is believed to be onto the route.
Eigen::Vector3d follow(const Route::Reference& reference, const Pose& T_world_body);

}  // namespace vinebench
