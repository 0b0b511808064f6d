// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "core/slam_system.h"

namespace vinebench::slam {

/// Runs a SLAM system as a robot does: on a thread of its own, always on the newest frame. A frame
/// that comes while one is being worked on waits; one that comes after it takes its place, and the
/// one that waited is dropped. Which frames are dropped depends on the machine, so the result does
/// too: experiments use the system itself, in lockstep. With `mapping.schedule: live` nor does
/// tracking wait for local mapping.
class LiveSlam {
 public:
  /// Called with each estimate, in order, on the thread of the system.
  using Listener = std::function<void(const Estimate&)>;

  /// The system must outlive this, and nothing else may use it before finish() has returned.
  LiveSlam(SlamSystem& system, Listener listener);
  LiveSlam(const LiveSlam&) = delete;
  LiveSlam& operator=(const LiveSlam&) = delete;

  /// Ends after the frame in work; the one that waits is not taken up.
  ~LiveSlam();

  /// Hands over the next frame and returns at once. Its images are shared, not copied: whoever
  /// gave them must not write to them again. Inertial and wheel samples of a dropped frame go to
  /// the frame that takes its place. Throws what the system or the listener threw since; Error
  /// after finish().
  void push(Frame frame);

  /// Frames dropped so far.
  std::int64_t dropped() const;

  /// Waits for the last frame and returns the system's summary. Throws as push does. Not to be
  /// called by the listener.
  SlamSummary finish();

 private:
  void run();
  std::optional<Frame> next();
  void stop(bool drop_waiting);
  void throw_if_unusable() const;

  SlamSystem& system_;
  Listener listener_;
  mutable std::mutex mutex_;  ///< of all below but the thread
  std::condition_variable wake_;
  std::optional<Frame> waiting_;
  std::int64_t dropped_ = 0;
  bool stopping_ = false;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace vinebench::slam
