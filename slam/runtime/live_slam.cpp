// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/live_slam.h"

#include <utility>

#include "core/util/error.h"

namespace vinebench::slam {
namespace {

/// Puts the samples of the frame before in front of a frame's own.
template <class Sample>
void prepend(const std::vector<Sample>& before, std::vector<Sample>& samples) {
  samples.insert(samples.begin(), before.begin(), before.end());
}

}  // namespace

LiveSlam::LiveSlam(SlamSystem& system, Listener listener)
    : system_(system), listener_(std::move(listener)), thread_([this] { run(); }) {}

LiveSlam::~LiveSlam() {
  stop(true);
}

void LiveSlam::push(Frame frame) {
  std::optional<Frame> replaced;  // its images are let go outside the lock
  {
    const std::lock_guard lock(mutex_);
    throw_if_unusable();
    replaced = std::exchange(waiting_, std::nullopt);
    if (replaced) {
      prepend(replaced->imu, frame.imu);
      prepend(replaced->wheels, frame.wheels);
      ++dropped_;
    }
    waiting_ = std::move(frame);
  }
  wake_.notify_one();
}

std::int64_t LiveSlam::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

SlamSummary LiveSlam::finish() {
  {
    const std::lock_guard lock(mutex_);
    throw_if_unusable();
  }
  stop(false);
  if (error_) std::rethrow_exception(error_);
  return system_.finish();
}

void LiveSlam::throw_if_unusable() const {
  if (error_) std::rethrow_exception(error_);
  if (stopping_) fail("a live SLAM system takes no frames and reports nothing after finish()");
}

void LiveSlam::stop(bool drop_waiting) {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    if (drop_waiting) waiting_.reset();
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

/// The newest frame, waited for; none when there will be no more.
std::optional<Frame> LiveSlam::next() {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [this] { return waiting_ || stopping_; });
  return std::exchange(waiting_, std::nullopt);
}

void LiveSlam::run() {
  try {
    while (const std::optional<Frame> frame = next()) {
      const Estimate estimate = system_.process(*frame);
      if (listener_) listener_(estimate);
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    error_ = std::current_exception();
  }
}

}  // namespace vinebench::slam
