// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/rover/driven_rover.h"

#include <algorithm>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

constexpr Stamp kControlPeriod = kNanosecondsPerSecond / 50;
constexpr Stamp kPosePeriod = kNanosecondsPerSecond / 400;

/// Moves the readings up to `stamp` from the front of one list to the end of another.
template <class Reading>
void move_until(Stamp stamp, std::vector<Reading>& from, std::vector<Reading>& to) {
  const auto end = std::ranges::find_if(from, [&](const Reading& r) { return r.stamp > stamp; });
  to.insert(to.end(), from.begin(), end);
  from.erase(from.begin(), end);
}

}  // namespace

DrivenRover::DrivenRover(const RoverConfig& rover, const WorldConfig& world,
                         const RouteConfig& route, std::uint64_t seed)
    : route_(route),
      imu_rate_hz_(rover.imu_rate_hz),
      rover_(rover, world, route_.start(), seed),
      first_reading_(rover_.inertial_reading()) {
  remember();
}

void DrivenRover::advance_to(Stamp stamp) {
  for (; next_control_ <= stamp; next_control_ += kControlPeriod) {
    drive_to(next_control_);
    if (!commanded_) steer(route_.at(next_control_));
  }
  drive_to(stamp);
  remember();
}

void DrivenRover::steer(const Route::Reference& reference) {
  if (reference.carried) {
    twist_.setZero();
    rover_.carry(reference);
    return;
  }
  twist_ = follow(reference, steered_by(next_control_));
  rover_.command(twist_);
}

/// With a stop at each inertial instant; stops do not change the physics.
void DrivenRover::drive_to(Stamp stamp) {
  for (;; ++path_count_) {
    const Stamp instant = stamp_of_frame(path_count_, imu_rate_hz_);
    if (instant > stamp) break;
    if (instant > rover_.now()) rover_.advance_to(instant, imu_, wheels_);
    collided_ = collided_ || (commanded_ && rover_.touches_obstacle());
    path_.push_back({instant, rover_.T_world_body()});
  }
  if (stamp > rover_.now()) rover_.advance_to(stamp, imu_, wheels_);
}

void DrivenRover::command(const Eigen::Vector3d& twist) {
  commanded_ = true;
  collided_ = false;
  twist_ = twist;
  rover_.command(twist);
}

void DrivenRover::steer_by(Stamp stamp, const Pose& T_world_body) {
  believed_ = {stamp, T_world_body};
}

/// The position loop's pose at a control instant.
Pose DrivenRover::steered_by(Stamp stamp) {
  if (!believed_) return rover_.T_world_body();
  Vector6d velocity = Vector6d::Zero();
  velocity.head<2>() = twist_.head<2>();
  velocity[5] = twist_.z();
  believed_ = {stamp, believed_->pose * step_of(velocity * to_seconds(stamp - believed_->stamp))};
  return believed_->pose;
}

void DrivenRover::advance_and_remember(Stamp stamp) {
  while (rover_.now() < stamp) {
    advance_to(std::min(stamp, (rover_.now() / kPosePeriod + 1) * kPosePeriod));
  }
}

void DrivenRover::remember() {
  if (poses_.empty() || poses_.back().stamp < rover_.now()) {
    poses_.push_back({rover_.now(), rover_.T_world_body()});
  }
}

void DrivenRover::forget_before(Stamp stamp) {
  while (poses_.size() > 1 && poses_[1].stamp <= stamp) poses_.pop_front();
}

Pose DrivenRover::T_world_body(Stamp stamp) const {
  const auto next = std::ranges::lower_bound(poses_, stamp, {}, &StampedPose::stamp);
  if (next == poses_.end()) {
    fail("the rover's pose at {} s is not known, only up to {} s", format_seconds(stamp),
         format_seconds(poses_.back().stamp));
  }
  if (next->stamp == stamp || next == poses_.begin()) return next->pose;
  const StampedPose& before = *std::prev(next);
  return interpolate(
      before.pose, next->pose,
      static_cast<double>(stamp - before.stamp) / static_cast<double>(next->stamp - before.stamp));
}

void DrivenRover::hand_out(Stamp stamp, std::vector<ImuSample>& imu,
                           std::vector<WheelSample>& wheels) {
  move_until(stamp, imu_, imu);
  move_until(stamp, wheels_, wheels);
}

void DrivenRover::hand_out_path(Stamp stamp, Trajectory& path) {
  move_until(stamp, path_, path);
}

}  // namespace vinebench::sim
