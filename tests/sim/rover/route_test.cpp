// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/route.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

RouteConfig::Waypoint waypoint(double x, double y, double heading_deg = 0) {
  RouteConfig::Waypoint result;
  result.position = {x, y};
  result.heading_deg = heading_deg;
  return result;
}

RouteConfig::Waypoint passed(double x, double y, double heading_deg = 0) {
  RouteConfig::Waypoint result = waypoint(x, y, heading_deg);
  result.pass = true;
  return result;
}

/// 0.5 m/s, 0.5 m/s^2, 90 deg/s, 90 deg/s^2.
RouteConfig route_of(std::vector<RouteConfig::Waypoint> waypoints) {
  RouteConfig config;
  config.speed = 0.5;
  config.acceleration = 0.5;
  config.turn_rate_deg = 90;
  config.turn_acceleration_deg = 90;
  config.waypoints = std::move(waypoints);
  return config;
}

TEST(RouteTest, SpeedIsATrapezoid) {
  const Route route(route_of({waypoint(1, 2), waypoint(3, 2)}));
  // 1 s up over 0.25 m, 1.5 m at 0.5 m/s in 3 s, 1 s down over 0.25 m.
  EXPECT_EQ(route.duration(), 5 * kNanosecondsPerSecond);
  EXPECT_NEAR(route.length(), 2, 1e-12);
  const Route::Reference up = route.at(kNanosecondsPerSecond / 2);
  EXPECT_NEAR(up.pose.x(), 1 + 0.5 * 0.5 * 0.25, 1e-12);
  EXPECT_NEAR(up.velocity.x(), 0.25, 1e-12);
  const Route::Reference middle = route.at(5 * kNanosecondsPerSecond / 2);
  EXPECT_NEAR(middle.pose.x(), 2, 1e-12);
  EXPECT_NEAR(middle.velocity.x(), 0.5, 1e-12);
  const Route::Reference down = route.at(9 * kNanosecondsPerSecond / 2);
  EXPECT_NEAR(down.pose.x(), 3 - 0.5 * 0.5 * 0.25, 1e-12);
  EXPECT_NEAR(down.velocity.x(), 0.25, 1e-12);
  EXPECT_EQ(route.at(route.duration()).pose, Eigen::Vector3d(3, 2, 0));
  EXPECT_EQ(route.at(route.duration()).velocity, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(route.at(-1).pose, route.start());
}

TEST(RouteTest, ShortLegIsATriangle) {
  const Route route(route_of({waypoint(0, 0), waypoint(0, -0.32)}));
  // Peak sqrt(0.5 * 0.32) = 0.4 m/s, 0.8 s up and 0.8 s down.
  EXPECT_EQ(route.duration(), from_seconds(1.6));
  EXPECT_NEAR(route.at(from_seconds(0.8)).velocity.y(), -0.4, 1e-9);
}

TEST(RouteTest, TheSlowerOfWayAndTurnSetsThePace) {
  // Turning by 360 deg at 90 deg/s with 90 deg/s^2 takes 5 s; 1 m alone would take 3 s.
  const Route turning(route_of({waypoint(0, 0), waypoint(1, 0, 360)}));
  EXPECT_EQ(turning.duration(), from_seconds(5));
  EXPECT_NEAR(turning.at(from_seconds(2.5)).velocity.z(), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(turning.at(from_seconds(2.5)).pose.z(), std::numbers::pi, 1e-12);
  EXPECT_NEAR(turning.at(from_seconds(2.5)).pose.x(), 0.5, 1e-12);
  // 2 m take 5 s; turning by 90 deg alone would take 2 s.
  const Route moving(route_of({waypoint(0, 0), waypoint(2, 0, 90)}));
  EXPECT_EQ(moving.duration(), from_seconds(5));
  EXPECT_NEAR(moving.at(from_seconds(5)).pose.z(), std::numbers::pi / 2, 1e-12);
}

/// 2 m along x, carried 0.5 m above the ground.
RouteConfig carried_route() {
  RouteConfig config = route_of({waypoint(0, 0), waypoint(2, 0)});
  config.waypoints.back().lift = 0.5;
  return config;
}

TEST(RouteTest, ACarriedLegIsRaisedMovedAndLowered) {
  const Route route(carried_route());
  // Up 0.5 m by a cosine of at most 0.5 m/s: T = pi / 2 s; 2 m take 1 + 3 + 1 s; T down again.
  const double lifting = std::numbers::pi / 2;
  EXPECT_EQ(route.duration(), from_seconds(5 + 2 * lifting));
  const Route::Reference rising = route.at(from_seconds(lifting / 2));
  EXPECT_TRUE(rising.carried);
  EXPECT_NEAR(rising.pose.x(), 0, 1e-9);
  EXPECT_NEAR(rising.lift, 0.25, 1e-8);
  EXPECT_NEAR(rising.lift_speed, 0.5, 1e-8);
  const Route::Reference aloft = route.at(from_seconds(lifting + 2.5));
  EXPECT_NEAR(aloft.pose.x(), 1, 1e-8);
  EXPECT_NEAR(aloft.lift, 0.5, 1e-12);
  EXPECT_NEAR(aloft.lift_speed, 0, 1e-12);
  const Route::Reference falling = route.at(from_seconds(1.5 * lifting + 5));
  EXPECT_NEAR(falling.pose.x(), 2, 1e-9);
  EXPECT_NEAR(falling.lift, 0.25, 1e-8);
  EXPECT_NEAR(falling.lift_speed, -0.5, 1e-8);
  EXPECT_FALSE(route.at(route.duration()).carried);
}

TEST(RouteTest, LiftedAndSetDownOnTheSpot) {
  RouteConfig config = route_of({waypoint(1, 0), waypoint(1, 0)});
  config.waypoints.back().lift = 0.5;
  const Route route(config);
  EXPECT_EQ(route.duration(), from_seconds(std::numbers::pi));
  EXPECT_NEAR(route.at(from_seconds(std::numbers::pi / 2)).lift, 0.5, 1e-12);
  EXPECT_EQ(route.at(from_seconds(1)).pose, route.start());
}

// What drives on while it is raised would drag its wheels.
TEST(RouteTest, StopsBeforeItIsLifted) {
  RouteConfig config = route_of({waypoint(0, 0), passed(2, 0), passed(4, 0), waypoint(6, 0)});
  config.waypoints[2].lift = 0.1;
  const Route route(config);
  // Three legs of 2 m, 5 s each, from rest to rest, and twice pi / 10 s.
  EXPECT_EQ(route.duration(),
            from_seconds(5) + from_seconds(5 + std::numbers::pi / 5) + from_seconds(5));
}

TEST(RouteTest, TheFirstWaypointHasNoLift) {
  RouteConfig config = route_of({waypoint(0, 0), waypoint(2, 0)});
  config.waypoints.front().lift = 0.1;
  EXPECT_THROW(Route{config}, Error);
}

TEST(RouteTest, TurnsOnTheSpotAccumulate) {
  const Route route(route_of({waypoint(0, 0, 90), waypoint(0, 0, 450), waypoint(0, 0, 90)}));
  EXPECT_EQ(route.duration(), from_seconds(10));
  EXPECT_NEAR(route.at(from_seconds(5)).pose.z(), 2.5 * std::numbers::pi, 1e-12);
  EXPECT_LT(route.at(from_seconds(7)).velocity.z(), 0);
  EXPECT_EQ(route.length(), 0);
}

TEST(RouteTest, WaitsStandStill) {
  std::vector<RouteConfig::Waypoint> waypoints{waypoint(0, 0), waypoint(2, 0), waypoint(2, 2)};
  waypoints[0].wait = 1;
  waypoints[1].wait = 2;
  waypoints[1].pass = true;  // waiting implies stopping
  waypoints[2].wait = 0.5;
  const Route route(route_of(waypoints));
  EXPECT_EQ(route.duration(), from_seconds(1 + 5 + 2 + 5 + 0.5));
  EXPECT_EQ(route.at(from_seconds(0.9)).velocity.norm(), 0);
  EXPECT_EQ(route.at(from_seconds(7)).pose, Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(route.at(from_seconds(7)).velocity.norm(), 0);
}

TEST(RouteTest, PassesStraightOnAtFullSpeed) {
  const Route route(route_of({waypoint(0, 0), passed(1, 0), waypoint(2, 0)}));
  EXPECT_EQ(route.duration(), from_seconds(5));  // as without the waypoint
  EXPECT_NEAR(route.at(from_seconds(2.5)).velocity.x(), 0.5, 1e-9);
}

TEST(RouteTest, PassesACornerAtBoundedKink) {
  const Route route(route_of({waypoint(0, 0), passed(1, 0), waypoint(1, 1)}));
  double slowest = 1;
  double kink = 0;
  Route::Reference last = route.at(0);
  const Stamp step = from_seconds(0.001);
  for (Stamp t = step; t < route.duration(); t += step) {
    const Route::Reference here = route.at(t);
    kink = std::max(kink, (here.velocity - last.velocity).norm());
    if (t > from_seconds(1) && t < route.duration() - from_seconds(1)) {
      slowest = std::min(slowest, here.velocity.norm());
    }
    last = here;
  }
  // 0.1 s of 0.5 m/s^2 instantaneously, plus the change within 1 ms.
  EXPECT_NEAR(kink, 0.05, 0.001);
  // A right angle turns a speed v by v * sqrt(2).
  EXPECT_NEAR(slowest, 0.05 / std::sqrt(2), 0.001);
}

TEST(RouteTest, IsContinuousAndKeepsItsLimits) {
  RouteConfig config = route_of({waypoint(0, 0), passed(0.3, 0), passed(0.5, 0.1, 30),
                                 passed(0.52, 0.1, 60), passed(0.5, 0.6, 120), waypoint(0, 1, 360),
                                 waypoint(0, 1, 0), waypoint(0, 1, 0), waypoint(3, 1, -90)});
  config.waypoints[4].speed = 0.2;
  const Route route(config);
  const double dt = 0.001;
  Route::Reference last = route.at(0);
  for (Stamp t = from_seconds(dt); t <= route.duration() + from_seconds(1); t += from_seconds(dt)) {
    const Route::Reference here = route.at(t);
    const double s = to_seconds(t);
    EXPECT_LE(here.velocity.head<2>().norm(), 0.5 + 1e-9) << s;
    EXPECT_LE(std::abs(here.velocity.z()), std::numbers::pi / 2 + 1e-9) << s;
    // The mean of the velocities at both ends, except for a kink of at most 0.05 m/s or 9 deg/s.
    const Eigen::Vector3d predicted = last.pose + 0.5 * dt * (last.velocity + here.velocity);
    EXPECT_LT((here.pose - predicted).head<2>().norm(), 0.05 * dt) << s;
    EXPECT_LT(std::abs((here.pose - predicted).z()), 0.16 * dt) << s;
    last = here;
  }
  EXPECT_NEAR((last.pose - Eigen::Vector3d(3, 1, -std::numbers::pi / 2)).norm(), 0, 1e-12);
}

TEST(RouteTest, OneWaypointIsAPlace) {
  RouteConfig config = route_of({waypoint(1, 2, 90)});
  config.waypoints[0].wait = 3;
  const Route route(config);
  EXPECT_EQ(route.duration(), from_seconds(3));
  EXPECT_EQ(route.at(from_seconds(9)).pose, route.start());
  EXPECT_NEAR(route.start().z(), std::numbers::pi / 2, 1e-12);
}

TEST(RouteTest, RefusesARouteWithoutWaypoints) {
  EXPECT_THAT([] { Route route(RouteConfig{}); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("waypoints")));
}

TEST(FollowTest, OnTheRouteItIsTheRoutesVelocityInTheBodyFrame) {
  // Facing north, going east: that is to the right.
  Pose body;
  body.rotation = from_roll_pitch_yaw({0, 0, std::numbers::pi / 2});
  const Route::Reference reference{{0, 0, std::numbers::pi / 2}, {0.4, 0, 0.1}};
  EXPECT_NEAR((follow(reference, body) - Eigen::Vector3d(0, -0.4, 0.1)).norm(), 0, 1e-12);
}

TEST(FollowTest, CorrectsTowardsTheRouteWithinLimits) {
  Pose body;
  body.translation = {1, 0.01, 0};
  body.rotation = from_roll_pitch_yaw({0, 0, 0});
  const Route::Reference near{{1, 0, 0.01}, {0, 0, 0}};
  // 2 per s on 1 cm and 0.01 rad.
  EXPECT_NEAR((follow(near, body) - Eigen::Vector3d(0, -0.02, 0.02)).norm(), 0, 1e-12);
  const Route::Reference far{{9, 0.01, 3}, {0, 0, 0}};
  EXPECT_NEAR((follow(far, body) - Eigen::Vector3d(0.3, 0, 1)).norm(), 0, 1e-12);
}

TEST(FollowTest, WholeTurnsAreNoError) {
  const Route::Reference reference{{0, 0, 4 * std::numbers::pi + 0.01}, {0, 0, 0}};
  EXPECT_NEAR(follow(reference, Pose{}).z(), 0.02, 1e-12);
}

}  // namespace
}  // namespace vinebench::sim
