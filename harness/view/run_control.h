// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>

#include "core/time.h"

namespace vinebench::harness {

/// Holds a run up between its frames, as its viewers want it. It knows no frame's content, so that
/// it can change none. For any number of threads.
class RunControl {
 public:
  struct State {
    bool paused = false;
    double speed = 0;  ///< times the run's own time, at most; as fast as it goes if 0
  };

  void pause(bool paused);
  /// One more frame; then it is paused.
  void step();
  /// Throws Error if it is negative or not finite.
  void set_speed(double speed);
  State state() const;

  /// Returns when the frame after the one with this stamp may come, or `stopped` returns true.
  void wait(Stamp stamp, const std::function<bool()>& stopped);
  /// s, in all calls of wait().
  double waited_seconds() const;

 private:
  using Clock = std::chrono::steady_clock;
  /// A frame at its instant, from which the speed is counted.
  struct Anchor {
    Stamp stamp = 0;
    Clock::time_point at;
  };
  std::optional<Clock::time_point> due(Stamp stamp);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  State state_;
  int steps_ = 0;  ///< frames that may come while it is paused
  std::optional<Anchor> anchor_;
  double waited_ = 0;  ///< s
};

}  // namespace vinebench::harness
