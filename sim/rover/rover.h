// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/config/config_field.h"
#include "core/frame.h"
#include "core/geometry/pose.h"
#include "sim/rover/route.h"
#include "sim/world/world.h"

namespace vinebench::sim {

/// A rover: its MuJoCo model, its cameras, its sensors' rates. Wheels: front-left, front-right,
/// rear-left, rear-right.
struct RoverConfig {
  std::filesystem::path model;   ///< MJCF file
  std::filesystem::path rig;     ///< rig YAML file
  double wheel_radius = 0.10;    ///< m
  double half_track = 0.19;      ///< m, body centre to wheel centre along y
  double half_wheelbase = 0.15;  ///< m, along x
  double max_torque = 5.0;       ///< Nm at the wheel
  double imu_rate_hz = 200;      ///< inertial readings a second
  double wheel_rate_hz = 100;    ///< wheel readings a second
  template <class Archive>
  void serialize(Archive& archive) {
    archive("model", model);
    archive("rig", rig);
    archive("wheel_radius", wheel_radius, Range::positive());
    archive("half_track", half_track, Range::positive());
    archive("half_wheelbase", half_wheelbase, Range::positive());
    archive("max_torque", max_torque, Range::positive());
    archive("imu_rate_hz", imu_rate_hz, Range::between(1, 1000));
    archive("wheel_rate_hz", wheel_rate_hz, Range::between(1, 1000));
  }
};

/// The rover in its world: MuJoCo physics with torque-limited speed loops on the four wheels.
class Rover {
 public:
  /// Stands at rest on the ground at `start` (x, y in m, heading in rad), settled. `seed` varies
  /// each motor's gain and each wheel's friction by up to 1 % and selects the missing vines. Throws
  /// Error for a model that is missing, invalid or inconsistent with `config`, and for a start
  /// inside an obstacle.
  Rover(const RoverConfig& config, const WorldConfig& world, const Eigen::Vector3d& start,
        std::uint64_t seed);
  Rover(Rover&&) noexcept;
  Rover& operator=(Rover&&) noexcept;
  ~Rover();

  /// Commanded body twist: forward and left in m/s, turn to the left in rad/s. Valid until the next
  /// command. Takes effect within one physics step (2.5 ms).
  void command(const Eigen::Vector3d& twist);

  /// Carried from now on, until the next command: external forces hold the body at the reference's
  /// place and height above the ground, and move on with its velocity. The wheels are commanded to
  /// stand still.
  void carry(const Route::Reference& reference);

  /// Steps the physics to `stamp` and appends the sensors' samples in (now, stamp]. Samples have no
  /// noise. Throws Error if the physics diverges.
  void advance_to(Stamp stamp, std::vector<ImuSample>& imu, std::vector<WheelSample>& wheels);

  Stamp now() const;
  Pose T_world_body() const;  ///< the true pose at `now`
  /// What an inertial unit without errors measures at `now`.
  ImuSample inertial_reading() const;
  /// Whether a part of it touches anything but the ground, at the end of the latest step.
  bool touches_obstacle() const;

 private:
  struct Physics;
  std::unique_ptr<Physics> physics_;
};

}  // namespace vinebench::sim
