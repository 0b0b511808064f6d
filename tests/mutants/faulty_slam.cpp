// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/mutants/faulty_slam.h"

#include <algorithm>

#include "core/util/random.h"

namespace vinebench::mutants {
namespace {

double path_until(const Trajectory& honest, std::size_t index) {
  double path = 0;
  for (std::size_t i = 1; i <= index; ++i) {
    path += (honest[i].pose.translation - honest[i - 1].pose.translation).norm();
  }
  return path;
}

Stamp nanoseconds(double seconds) {
  return static_cast<Stamp>(seconds * static_cast<double>(kNanosecondsPerSecond));
}

/// The last pose at or before a stamp, else the first one.
std::size_t index_at(const Trajectory& honest, Stamp stamp) {
  const auto after = std::ranges::upper_bound(honest, stamp, {}, &StampedPose::stamp);
  return after == honest.begin() ? 0 : static_cast<std::size_t>(after - honest.begin()) - 1;
}

/// The pose that the velocity at `from` leads to.
Pose extrapolated(const Trajectory& honest, std::size_t from, Stamp stamp) {
  if (from == 0) return honest.front().pose;
  const StampedPose& last = honest[from];
  const Stamp step = last.stamp - honest[from - 1].stamp;
  const double steps = static_cast<double>(stamp - last.stamp) / static_cast<double>(step);
  Pose pose = last.pose;
  pose.translation += steps * (last.pose.translation - honest[from - 1].pose.translation);
  return pose;
}

Eigen::Vector3d noise(Stamp stamp, double sigma) {
  const RandomStream random(1, "misreported");
  const auto first = 3 * static_cast<std::uint64_t>(stamp);
  return sigma *
         Eigen::Vector3d(random.normal(first), random.normal(first + 1), random.normal(first + 2));
}

}  // namespace

Pose misreported(const Trajectory& honest, std::size_t index, const EstimatorFault& fault,
                 Stamp middle) {
  const auto& [stamp, pose] = honest[index];
  const Pose& first = honest.front().pose;
  const Eigen::Vector3d left = first.rotation * Eigen::Vector3d::UnitY();
  const double size = fault.size;
  const bool later = stamp >= middle;
  Pose wrong = pose;
  switch (fault.fault) {
    case Fault::kScale:
      wrong.translation += size * (pose.translation - first.translation);
      break;
    case Fault::kLate:
      wrong = honest[index_at(honest, stamp - nanoseconds(size))].pose;
      break;
    case Fault::kJump:
      if (later) wrong.translation += size * left;
      break;
    case Fault::kJumpBack:
      if (later && stamp < middle + kNanosecondsPerSecond) wrong.translation += size * left;
      break;
    case Fault::kDrift:
      wrong.translation += size * path_until(honest, index) * left;
      break;
    case Fault::kHeadingDrift:
      wrong.rotation = pose.rotation * exp_so3({0, 0, size * path_until(honest, index)});
      break;
    case Fault::kTilt:
      if (later) wrong.rotation = pose.rotation * exp_so3({size, 0, 0});
      break;
    case Fault::kClimb:
      wrong.translation +=
          size * path_until(honest, index) * (first.rotation * Eigen::Vector3d::UnitZ());
      break;
    case Fault::kFrozen:
      if (later && stamp < middle + nanoseconds(size))
        wrong = honest[index_at(honest, middle)].pose;
      break;
    case Fault::kSilentLoss:
      if (later && stamp < middle + nanoseconds(size)) {
        wrong = extrapolated(honest, index_at(honest, middle), stamp);
      }
      break;
    case Fault::kNoise:
      wrong.translation += noise(stamp, size);
      break;
    default:
      break;
  }
  return wrong;
}

FaultySlam::FaultySlam(SlamSystem& inner, EstimatorFault fault, std::int64_t frames, double rate_hz)
    : inner_(inner), fault_(fault), middle_(stamp_of_frame(frames / 2, rate_hz)) {}

bool FaultySlam::is_in_window(Stamp stamp) const {
  return stamp >= middle_ && stamp < middle_ + nanoseconds(fault_.size);
}

/// As soon as there has been time enough for a loop.
void FaultySlam::close_falsely(Estimate& estimate) {
  constexpr Stamp kAgo = 4 * kNanosecondsPerSecond;
  if (!closed_ && estimate.stamp >= middle_ + kAgo / 2 && estimate.stamp >= kAgo) {
    closed_ = estimate.stamp;
    const StampedPose& earlier = live_[index_at(live_, estimate.stamp - kAgo)];
    Pose T_earlier_later = earlier.pose.inverse() * live_.back().pose;
    T_earlier_later.translation.y() += fault_.size;
    estimate.loop_closure = LoopClosure{.tag_id = 0,
                                        .earlier = earlier.stamp,
                                        .later = estimate.stamp,
                                        .T_earlier_later = T_earlier_later,
                                        .correction = fault_.size};
  }
  if (closed_) estimate.T_map_body->translation.y() += fault_.size;
}

Estimate FaultySlam::process(const Frame& frame) {
  Estimate estimate = inner_.process(frame);
  if (fault_.fault == Fault::kCovariance) estimate.covariance *= fault_.size;
  if (!estimate.T_map_body) return estimate;
  live_.push_back({estimate.stamp, *estimate.T_map_body});
  if (fault_.fault == Fault::kOpenLoss && is_in_window(estimate.stamp)) {
    estimate.T_map_body.reset();
    estimate.status = TrackingStatus::kLost;
    return estimate;
  }
  estimate.T_map_body = misreported(live_, live_.size() - 1, fault_, middle_);
  if (fault_.fault == Fault::kFalseLoop) close_falsely(estimate);
  return estimate;
}

SlamSummary FaultySlam::finish() {
  SlamSummary summary = inner_.finish();
  const Trajectory honest = summary.trajectory;
  for (std::size_t i = 0; i < honest.size(); ++i) {
    Pose& pose = summary.trajectory[i].pose;
    pose = misreported(honest, i, fault_, middle_);
    if (closed_ && honest[i].stamp >= *closed_) pose.translation.y() += fault_.size;
  }
  if (fault_.fault == Fault::kWorld && summary.T_world_map) {
    summary.T_world_map->translation.x() += fault_.size;
  }
  return summary;
}

}  // namespace vinebench::mutants
