// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/view/run_control.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A run of frames every 0.1 s on a thread of its own.
class Frames {
 public:
  explicit Frames(RunControl& control)
      : thread_([this, &control] {
          while (!stop_) {
            ++count_;
            control.wait(count_ * 100'000'000, [this] { return stop_.load(); });
          }
        }) {}
  ~Frames() {
    stop_ = true;
    thread_.join();
  }
  std::int64_t count() const { return count_; }
  /// Whether so many have come within a while.
  bool reach(std::int64_t count) const {
    const Clock::time_point start = Clock::now();
    while (count_ < count && seconds_since(start) < 20) std::this_thread::sleep_for(1ms);
    return count_ >= count;
  }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<std::int64_t> count_{0};
  std::thread thread_;
};

TEST(RunControlTest, HoldsNothingUpByItself) {
  RunControl control;
  const Frames frames(control);
  EXPECT_TRUE(frames.reach(1000));
}

TEST(RunControlTest, PausesAndGoesOn) {
  RunControl control;
  control.pause(true);
  const Frames frames(control);
  ASSERT_TRUE(frames.reach(1));
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(frames.count(), 1);
  control.pause(false);
  EXPECT_TRUE(frames.reach(100));
}

TEST(RunControlTest, AStepIsOneFrame) {
  RunControl control;
  control.pause(true);
  const Frames frames(control);
  ASSERT_TRUE(frames.reach(1));
  for (int step = 1; step <= 3; ++step) {
    control.step();
    ASSERT_TRUE(frames.reach(1 + step));
  }
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(frames.count(), 4);
  EXPECT_TRUE(control.state().paused);
}

TEST(RunControlTest, AStepPausesARunThatGoesOn) {
  RunControl control;
  control.step();
  EXPECT_TRUE(control.state().paused);
}

TEST(RunControlTest, IsNoFasterThanItsSpeed) {
  RunControl control;
  control.set_speed(4);
  const Clock::time_point start = Clock::now();
  // Eleven frames a tenth of a second apart: 1 s between the first and the last, at four times the
  // speed 0.25 s. A loaded machine may make it longer.
  for (Stamp i = 0; i <= 10; ++i) control.wait(i * 100'000'000, {});
  EXPECT_GE(seconds_since(start), 0.249);
  EXPECT_NEAR(control.waited_seconds(), seconds_since(start), 0.1);
}

TEST(RunControlTest, LostTimeIsNotMadeUpFor) {
  RunControl control;
  control.set_speed(1);
  control.wait(0, {});
  std::this_thread::sleep_for(1s);  // a slow frame
  const Clock::time_point start = Clock::now();
  for (Stamp i = 1; i <= 3; ++i) control.wait(i * 100'000'000, {});
  EXPECT_GE(seconds_since(start), 0.199);  // two distances of 0.1 s after the first
}

TEST(RunControlTest, AnInterruptionEndsAPause) {
  RunControl control;
  control.pause(true);
  const Clock::time_point start = Clock::now();
  control.wait(0, [&] { return seconds_since(start) > 0.1; });
  EXPECT_GE(seconds_since(start), 0.1);
}

TEST(RunControlTest, SpeedsAreNumbers) {
  RunControl control;
  EXPECT_THROW(control.set_speed(-1), Error);
  EXPECT_THROW(control.set_speed(std::nan("")), Error);
}

}  // namespace
}  // namespace vinebench::harness
