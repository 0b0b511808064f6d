// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/route.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/config/validate.h"

namespace vinebench::sim {
namespace {

constexpr double kStandstill = 1e-9;  // m or rad: shorter legs are empty
constexpr double kKinkSeconds =
    0.1;  // of acceleration, as an instantaneous change at a passed waypoint
constexpr double kLiftSpeed = 0.5;        // m/s, at most
constexpr double kCorrection = 2;         // 1/s
constexpr double kMaxCorrection = 0.3;    // m/s
constexpr double kMaxTurnCorrection = 1;  // rad/s

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

Eigen::Vector3d pose_of(const RouteConfig::Waypoint& waypoint) {
  return {waypoint.position.x(), waypoint.position.y(), radians(waypoint.heading_deg)};
}

/// Maximum speed from which `end_speed` is reached within the distance.
double braking_speed(double end_speed, double acceleration, double distance) {
  return std::sqrt(end_speed * end_speed + 2 * acceleration * distance);
}

Eigen::Vector2d limited(const Eigen::Vector2d& vector, double limit) {
  const double norm = vector.norm();
  return norm > limit ? Eigen::Vector2d(vector * (limit / norm)) : vector;
}

}  // namespace

double Route::Leg::peak() const {
  const double reachable =
      std::sqrt(acceleration * length + 0.5 * (speed_in * speed_in + speed_out * speed_out));
  return std::min(speed, reachable);
}

double Route::Leg::seconds() const {
  if (length < kStandstill) return 0;
  const double top = peak();
  const double ramps = (2 * top - speed_in - speed_out) / acceleration;
  const double length_of_ramps =
      (2 * top * top - speed_in * speed_in - speed_out * speed_out) / (2 * acceleration);
  return ramps + std::max(0.0, length - length_of_ramps) / top;
}

double Route::Leg::lifting_seconds() const {
  return 0.5 * std::numbers::pi * lift / kLiftSpeed;
}

/// Height lift * (1 - cos(pi t / T)) / 2, whose speed is at most lift * pi / (2 T).
void Route::Leg::set_lift(double t, Reference& reference) const {
  const double whole = lifting_seconds();
  const double rising = std::clamp(t, 0.0, whole);
  const double falling = std::clamp(t - whole - seconds(), 0.0, whole);
  const double phase = std::numbers::pi * (rising - falling) / whole;
  reference.carried = true;
  reference.lift = 0.5 * lift * (1 - std::cos(phase));
  reference.lift_speed = (falling > 0 ? -kLiftSpeed : kLiftSpeed) * std::sin(phase);
}

Route::Reference Route::Leg::at(double t) const {
  if (lift == 0) return along(t);
  Reference reference = along(std::clamp(t - lifting_seconds(), 0.0, seconds()));
  set_lift(t, reference);
  return reference;
}

Route::Reference Route::Leg::along(double t) const {
  if (length < kStandstill) return {from, Eigen::Vector3d::Zero()};
  const double top = peak();
  const double remaining = seconds() - t;
  const double braking = (top - speed_out) / acceleration;
  double s = 0;
  double v = top;
  if (remaining < braking) {
    v = speed_out + acceleration * remaining;
    s = length - 0.5 * (v + speed_out) * remaining;
  } else if (t < (top - speed_in) / acceleration) {
    v = speed_in + acceleration * t;
    s = 0.5 * (v + speed_in) * t;
  } else {
    s = length - 0.5 * (top + speed_out) * braking - top * (remaining - braking);
  }
  return {from + std::clamp(s, 0.0, length) * direction, v * direction};
}

Route::Leg Route::make_leg(const RouteConfig& config, std::size_t index) {
  const RouteConfig::Waypoint& waypoint = config.waypoints[index];
  Leg leg;
  leg.from = pose_of(config.waypoints[index - 1]);
  leg.wait = waypoint.wait;
  leg.lift = waypoint.lift;
  const Eigen::Vector3d change = pose_of(waypoint) - leg.from;
  const double distance = change.head<2>().norm();
  const double turn = std::abs(change.z());
  leg.turns_only = distance < kStandstill;
  leg.length = leg.turns_only ? turn : distance;
  if (leg.length < kStandstill) return leg;
  leg.direction = change / leg.length;
  const double turn_rate = radians(config.turn_rate_deg);
  const double turn_acceleration = radians(config.turn_acceleration_deg);
  if (leg.turns_only) {
    leg.speed = turn_rate;
    leg.acceleration = turn_acceleration;
    return leg;
  }
  leg.speed = waypoint.speed.value_or(config.speed);
  leg.acceleration = config.acceleration;
  if (turn > kStandstill) {
    leg.speed = std::min(leg.speed, turn_rate * distance / turn);
    leg.acceleration = std::min(leg.acceleration, turn_acceleration * distance / turn);
  }
  return leg;
}

double Route::passing_speed(const RouteConfig& config, const Leg& in, const Leg& out) {
  if (in.turns_only != out.turns_only || out.length < kStandstill) return 0;
  if (in.lift > 0 || out.lift > 0) return 0;
  const Eigen::Vector3d kink = out.direction - in.direction;
  double speed = std::min(in.speed, out.speed);
  const double along = kink.head<2>().norm();
  const double turn = std::abs(kink.z());
  if (along > kStandstill) speed = std::min(speed, config.acceleration * kKinkSeconds / along);
  if (turn > kStandstill) {
    speed = std::min(speed, radians(config.turn_acceleration_deg) * kKinkSeconds / turn);
  }
  return speed;
}

void Route::set_passing_speeds(const RouteConfig& config) {
  for (std::size_t i = legs_.size(); i-- > 1;) {
    const RouteConfig::Waypoint& between = config.waypoints[i];
    Leg& in = legs_[i - 1];
    Leg& out = legs_[i];
    if (!between.pass || between.wait > 0) continue;
    in.speed_out = std::min(passing_speed(config, in, out),
                            braking_speed(out.speed_out, out.acceleration, out.length));
  }
  for (std::size_t i = 1; i < legs_.size(); ++i) {
    Leg& in = legs_[i - 1];
    in.speed_out = std::min(in.speed_out, braking_speed(in.speed_in, in.acceleration, in.length));
    legs_[i].speed_in = in.speed_out;
  }
}

void Route::schedule(double first_wait) {
  Stamp time = from_seconds(first_wait);
  for (Leg& leg : legs_) {
    leg.begin = time;
    leg.end = time + from_seconds(leg.seconds() + 2 * leg.lifting_seconds());
    time = leg.end + from_seconds(leg.wait);
  }
  duration_ = time;
}

Route::Route(const RouteConfig& config) {
  validate(config);
  start_ = pose_of(config.waypoints.front());
  for (std::size_t i = 1; i < config.waypoints.size(); ++i) legs_.push_back(make_leg(config, i));
  set_passing_speeds(config);
  schedule(config.waypoints.front().wait);
}

Route::Reference Route::at(Stamp stamp) const {
  Reference reference{start_, Eigen::Vector3d::Zero()};
  for (const Leg& leg : legs_) {
    if (stamp < leg.begin) break;
    if (stamp < leg.end) return leg.at(to_seconds(stamp - leg.begin));
    reference.pose = leg.to();
  }
  return reference;
}

double Route::length() const {
  double sum = 0;
  for (const Leg& leg : legs_) sum += leg.turns_only ? 0 : leg.length;
  return sum;
}

Eigen::Vector3d follow(const Route::Reference& reference, const Pose& T_world_body) {
  const double yaw = yaw_of(T_world_body.rotation);
  const Eigen::Vector2d error = reference.pose.head<2>() - T_world_body.translation.head<2>();
  const double yaw_error = std::remainder(reference.pose.z() - yaw, 2 * std::numbers::pi);
  const Eigen::Vector2d v_world =
      reference.velocity.head<2>() + limited(kCorrection * error, kMaxCorrection);
  const double turn = reference.velocity.z() +
                      std::clamp(kCorrection * yaw_error, -kMaxTurnCorrection, kMaxTurnCorrection);
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  return {c * v_world.x() + s * v_world.y(), c * v_world.y() - s * v_world.x(), turn};
}

}  // namespace vinebench::sim
