// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "core/geometry/pose.h"
#include "core/time.h"

namespace vinebench::sim {

/// The source of the position loop's pose.
enum class Steering {
  kTruth,     ///< from the simulation: the path does not depend on the estimate
  kEstimate,  ///< from the SLAM system under test, as a robot would
};

inline std::vector<std::string> yaml_names(Steering) {
  return {"truth", "estimate"};
}

/// The route of an omnidirectional rover: position and heading are independent.
struct RouteConfig {
  struct Waypoint {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, world
    double heading_deg = 0;       ///< not wrapped: 360 more is one more turn to the left
    std::optional<double> speed;  ///< m/s on the leg to this waypoint; the route's if absent
    double wait = 0;              ///< s to wait here
    bool pass = false;            ///< drive through without stopping
    double lift = 0;  ///< m, if the rover is carried to this waypoint: so high; 0 if it drives
    template <class Archive>
    void serialize(Archive& archive) {
      archive("position", position);
      archive("heading_deg", heading_deg);
      archive("speed", speed, Range::positive());
      archive("wait", wait, Range::non_negative());
      archive("pass", pass);
      archive("lift", lift, Range::between(0, 2));
    }
  };
  double speed = 0.3;                    ///< m/s
  double turn_rate_deg = 45;             ///< deg/s
  double acceleration = 0.5;             ///< m/s^2
  double turn_acceleration_deg = 120;    ///< deg/s^2
  Steering steering = Steering::kTruth;  ///< the pose that the position loop is given
  std::vector<Waypoint> waypoints;       ///< the first is the start pose
  template <class Archive>
  void serialize(Archive& archive) {
    archive("speed", speed, Range::positive());
    archive("turn_rate_deg", turn_rate_deg, Range::positive());
    archive("acceleration", acceleration, Range::positive());
    archive("turn_acceleration_deg", turn_acceleration_deg, Range::positive());
    archive("steering", steering);
    archive("waypoints", waypoints);
    archive.require(!waypoints.empty(), "waypoints", "expected at least one waypoint");
    archive.require(waypoints.empty() || waypoints.front().lift == 0, "waypoints",
                    "expected a first one without lift, where the rover stands");
  }
};

/// The route as a function of time: the desired body pose.
///
/// A leg joins two waypoints on a straight line, with position and heading in proportion, so that
/// both arrive together: the slower one limits the speed. The speed profile is a trapezoid. A
/// waypoint to `pass` is passed at the maximum speed at which the instantaneous change of velocity
/// to the next leg is at most what the accelerations give in 0.1 s.
///
/// A leg with a lift is carried: the rover is raised on the spot, moved through the air, and set
/// down, as by two persons. Raising and lowering follow a cosine, with at most 0.5 m/s.
class Route {
 public:
  explicit Route(const RouteConfig& config);

  struct Reference {
    Eigen::Vector3d pose;      ///< x, y (m), accumulated heading (rad), world
    Eigen::Vector3d velocity;  ///< of these, per s
    bool carried = false;
    double lift = 0;        ///< m above the ground, while carried
    double lift_speed = 0;  ///< m/s, upwards
  };
  /// The start pose before t = 0, the end pose after the last leg.
  Reference at(Stamp stamp) const;
  Stamp duration() const { return duration_; }
  Eigen::Vector3d start() const { return start_; }
  double length() const;  ///< m, of the path of the body's centre

 private:
  /// Distance and speeds are those of the body's centre in m, or of its heading in rad for a leg
  /// that only turns.
  struct Leg {
    Stamp begin = 0;
    Stamp end = 0;
    Eigen::Vector3d from = Eigen::Vector3d::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< of the pose, per unit of distance
    double length = 0;
    double speed = 0;  ///< limit
    double acceleration = 0;
    double speed_in = 0;
    double speed_out = 0;
    double wait = 0;  ///< s, at its end
    double lift = 0;  ///< m
    bool turns_only = false;

    Eigen::Vector3d to() const { return from + length * direction; }
    double peak() const;
    double seconds() const;
    double lifting_seconds() const;  ///< to raise the rover, and again to lower it
    Reference at(double t) const;
    Reference along(double t) const;
    void set_lift(double t, Reference& reference) const;
  };
  static Leg make_leg(const RouteConfig& config, std::size_t index);
  static double passing_speed(const RouteConfig& config, const Leg& in, const Leg& out);
  void set_passing_speeds(const RouteConfig& config);
  void schedule(double first_wait);

  Eigen::Vector3d start_;
  std::vector<Leg> legs_;
  Stamp duration_ = 0;
};

/// Position loop: the body twist (forward, left in m/s, turn in rad/s) that steers the body from
/// the given pose to the route: the route's velocity plus a correction proportional to the error (2
/// per s, at most 0.3 m/s and 1 rad/s), for rates of 15 Hz or more.
Eigen::Vector3d follow(const Route::Reference& reference, const Pose& T_world_body);

}  // namespace vinebench::sim
