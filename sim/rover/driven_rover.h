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

/// The rover under its position loop, with a short memory of where it was.
class DrivenRover {
 public:
  DrivenRover(const RoverConfig& rover, const WorldConfig& world, const RouteConfig& route,
              std::uint64_t seed);

  const Route& route() const { return route_; }

  /// Drives to `stamp`; nothing happens where it is past it.
  void advance_to(Stamp stamp);
  /// Drives to `stamp` and remembers the poses on the way, every 2.5 ms (a step of the physics).
  void advance_and_remember(Stamp stamp);
  /// Forgets the poses that only instants before `stamp` need.
  void forget_before(Stamp stamp);

  /// From now on the position loop goes by this pose, of the instant `stamp`, and by what was
  /// commanded since, in place of the true one.
  void steer_by(Stamp stamp, const Pose& T_world_body);

  /// The truth at a remembered instant, linear between two poses; the start's before t = 0.
  Pose T_world_body(Stamp stamp) const;

  /// Moves the true readings up to `stamp` that were not handed out before to the end of the lists.
  void hand_out(Stamp stamp, std::vector<ImuSample>& imu, std::vector<WheelSample>& wheels);

 private:
  void remember();
  Pose steered_by(Stamp stamp);

  Route route_;
  Rover rover_;
  Stamp next_control_ = 0;
  Eigen::Vector3d twist_ = Eigen::Vector3d::Zero();  ///< commanded: m/s ahead, left; rad/s
  std::optional<StampedPose> believed_;              ///< what is steered by; the truth where absent
  std::deque<StampedPose> poses_;
  std::vector<ImuSample> imu_;
  std::vector<WheelSample> wheels_;
};

}  // namespace vinebench::sim
