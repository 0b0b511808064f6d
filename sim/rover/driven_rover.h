// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "core/frame.h"
#include "core/trajectory.h"
#include "sim/rover/route.h"
#include "sim/rover/rover.h"

namespace vinebench::sim {

/// The rover with its position loop and a short history of its poses. Commands take the loop's
/// place.
class DrivenRover {
 public:
  DrivenRover(const RoverConfig& rover, const WorldConfig& world, const RouteConfig& route,
              std::uint64_t seed);

  const Route& route() const { return route_; }

  /// Drives to `stamp`; no effect if it is in the past.
  void advance_to(Stamp stamp);
  /// Drives to `stamp` and records the poses every 2.5 ms (a step of the physics).
  void advance_and_remember(Stamp stamp);
  /// Removes poses that are needed for instants before `stamp` only.
  void forget_before(Stamp stamp);

  /// From now on the position loop uses this pose, of the instant `stamp`, and the commands since
  /// then, instead of the true pose.
  void steer_by(Stamp stamp, const Pose& T_world_body);

  /// From now on this body twist (m/s forward, left; rad/s to the left) drives it, in place of the
  /// route.
  void command(const Eigen::Vector3d& twist);

  /// Since the latest command: whether it touched anything but the ground, looked at 200 times a
  /// second (at the inertial unit's rate).
  bool collided() const { return collided_; }

  /// The true pose at a recorded instant, linearly interpolated; the start pose before t = 0.
  Pose T_world_body(Stamp stamp) const;

  /// Appends the true readings up to `stamp` that have not been taken yet.
  void hand_out(Stamp stamp, std::vector<ImuSample>& imu, std::vector<WheelSample>& wheels);
  /// Likewise the true poses at the start and at the inertial unit's instants.
  void hand_out_path(Stamp stamp, Trajectory& path);

  /// What an inertial unit would measure at the start, at rest.
  const ImuSample& first_reading() const { return first_reading_; }

 private:
  void remember();
  void steer(const Route::Reference& reference);
  void drive_to(Stamp stamp);
  Pose steered_by(Stamp stamp);

  Route route_;
  double imu_rate_hz_;
  Rover rover_;
  ImuSample first_reading_;
  Stamp next_control_ = 0;
  Eigen::Vector3d twist_ = Eigen::Vector3d::Zero();  ///< commanded: m/s forward, left; rad/s
  bool commanded_ = false;                           ///< by twists; by the route if not
  bool collided_ = false;
  std::optional<StampedPose> believed_;  ///< pose for steering; the truth if absent
  std::deque<StampedPose> poses_;
  std::vector<ImuSample> imu_;
  std::vector<WheelSample> wheels_;
  Trajectory path_;
  std::int64_t path_count_ = 0;  ///< poses of the path so far
};

}  // namespace vinebench::sim
