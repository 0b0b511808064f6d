// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/frame_timing.h"

#include <algorithm>
#include <cmath>

#include "core/util/error.h"
#include "core/util/random.h"

namespace vinebench::sim {
namespace {

constexpr double kMostSigmas = 3;

}  // namespace

FrameTiming::FrameTiming(const FrameTimingConfig& timing, const FrameDropConfig& drops,
                         const Rig& rig, std::uint64_t seed)
    : timing_(timing), drops_(drops), rate_hz_(rig.rate_hz), seed_(seed) {
  if (!(2 * kMostSigmas * timing.stamp_jitter < 1 / rate_hz_)) {
    fail(
        "sensors.timing.stamp_jitter: expected less than a sixth of the {} s between frames, found "
        "{}",
        1 / rate_hz_, timing.stamp_jitter);
  }
  for (const RigCamera& camera : rig.cameras) cameras_.push_back(camera.name);
  delays_.resize(cameras_.size());
  for (const FrameTimingConfig::Trigger& trigger : timing.triggers) {
    const int camera = rig.find_camera(trigger.camera);
    if (camera < 0) {
      fail("sensors.timing.triggers: rig '{}' has no camera named '{}'", rig.name, trigger.camera);
    }
    const Stamp delay = from_seconds(trigger.delay);
    delays_[static_cast<std::size_t>(camera)] = delay;
    if (!trigger.stamped) continue;
    if (!(2 * std::abs(trigger.delay) < 1 / rate_hz_)) {
      fail(
          "sensors.timing.triggers: camera '{}': expected a stamped delay of less than half of the "
          "{} s between frames, found {}",
          trigger.camera, 1 / rate_hz_, trigger.delay);
    }
    stamped_delays_.resize(cameras_.size());
    stamped_delays_[static_cast<std::size_t>(camera)] = delay;
  }
}

Stamp FrameTiming::stamp(std::int64_t frame) const {
  const RandomStream stream(seed_, "timing.stamp_jitter", static_cast<std::uint64_t>(frame));
  const double draw = std::clamp(stream.normal(0), -kMostSigmas, kMostSigmas);
  return instant(frame) + from_seconds(timing_.stamp_offset + timing_.stamp_jitter * draw);
}

std::vector<Stamp> FrameTiming::image_stamps(std::int64_t frame) const {
  std::vector<Stamp> stamps = stamped_delays_;
  for (Stamp& one : stamps) one += stamp(frame);
  return stamps;
}

bool FrameTiming::is_dropped(std::int64_t frame, std::size_t camera) const {
  const auto counter = static_cast<std::uint64_t>(frame);
  const RandomStream one(seed_, "drops.camera." + std::to_string(camera), counter);
  const RandomStream all(seed_, "drops.frame", counter);
  if (one.uniform(0) < drops_.camera_rate || all.uniform(0) < drops_.frame_rate) return true;
  return std::ranges::any_of(drops_.bursts, [&](const FaultScope& burst) {
    return burst.applies_to(cameras_[camera]) && burst.is_active(instant(frame));
  });
}

Stamp FrameTiming::longest_delay() const {
  Stamp longest = 0;
  for (const Stamp delay : delays_) longest = std::max(longest, std::abs(delay));
  return longest;
}

}  // namespace vinebench::sim
