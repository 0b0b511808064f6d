// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/view/run_control.h"

#include <cmath>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

constexpr std::chrono::milliseconds kPoll{50};  // of `stopped`
// Behind by more than this, time that was lost is not made up for.
constexpr std::chrono::milliseconds kLate{200};

}  // namespace

void RunControl::pause(bool paused) {
  const std::lock_guard lock(mutex_);
  state_.paused = paused;
  steps_ = 0;
  anchor_.reset();
  changed_.notify_all();
}

void RunControl::step() {
  const std::lock_guard lock(mutex_);
  state_.paused = true;
  ++steps_;
  changed_.notify_all();
}

void RunControl::set_speed(double speed) {
  if (!std::isfinite(speed) || speed < 0) fail("speed: expected 0 or more, found {}", speed);
  const std::lock_guard lock(mutex_);
  state_.speed = speed;
  anchor_.reset();
  changed_.notify_all();
}

RunControl::State RunControl::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

/// When the frame after `stamp` may come, by the speed.
std::optional<RunControl::Clock::time_point> RunControl::due(Stamp stamp) {
  if (state_.speed == 0) return std::nullopt;
  const Clock::time_point now = Clock::now();
  if (anchor_) {
    const std::chrono::duration<double> since(to_seconds(stamp - anchor_->stamp) / state_.speed);
    const auto at = anchor_->at + std::chrono::duration_cast<Clock::duration>(since);
    if (now < at + kLate) return at;
  }
  anchor_ = {stamp, now};
  return now;
}

void RunControl::wait(Stamp stamp, const std::function<bool()>& stopped) {
  const Clock::time_point start = Clock::now();
  std::unique_lock lock(mutex_);
  while (!stopped || !stopped()) {
    if (state_.paused) {
      if (steps_ > 0) {
        --steps_;
        break;
      }
      changed_.wait_for(lock, kPoll);
      continue;
    }
    const std::optional<Clock::time_point> at = due(stamp);
    if (!at || *at <= Clock::now()) break;
    changed_.wait_until(lock, std::min(*at, Clock::now() + kPoll));
  }
  waited_ += std::chrono::duration<double>(Clock::now() - start).count();
}

double RunControl::waited_seconds() const {
  const std::lock_guard lock(mutex_);
  return waited_;
}

}  // namespace vinebench::harness
