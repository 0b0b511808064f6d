// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/frame_timing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/util/error.h"

namespace vinebench::sim {
namespace {

constexpr std::int64_t kFrames = 20000;

Rig two_cameras() {
  Rig rig;
  rig.rate_hz = 15;
  for (const char* name : {"left", "right"}) rig.cameras.push_back({name, {}, {}});
  return rig;
}

TEST(FrameTimingTest, ExactByDefault) {
  const FrameTiming timing({}, {}, two_cameras(), 1);
  for (std::int64_t frame = 0; frame < 100; ++frame) {
    EXPECT_EQ(timing.stamp(frame), stamp_of_frame(frame, 15));
    EXPECT_EQ(timing.instant(frame, 1), stamp_of_frame(frame, 15));
    EXPECT_FALSE(timing.is_dropped(frame, 0));
  }
  EXPECT_EQ(timing.longest_delay(), 0);
}

TEST(FrameTimingTest, JitterHasItsDeviationAndStampsAscend) {
  FrameTimingConfig config;
  config.stamp_jitter = 0.005;
  config.stamp_offset = 0.01;
  const FrameTiming timing(config, {}, two_cameras(), 1);
  double sum = 0, squares = 0;
  for (std::int64_t frame = 0; frame < kFrames; ++frame) {
    const double error = to_seconds(timing.stamp(frame) - timing.instant(frame));
    sum += error;
    squares += error * error;
    EXPECT_GT(timing.stamp(frame + 1), timing.stamp(frame));
  }
  const double mean = sum / kFrames;
  EXPECT_NEAR(mean, 0.01, 4 * 0.005 / std::sqrt(kFrames));
  // Draws end at three deviations, which takes 0.4 % off; the rest is 1 / sqrt(2 n) = 0.5 %.
  EXPECT_NEAR(std::sqrt(squares / kFrames - mean * mean), 0.005, 0.02 * 0.005);
}

TEST(FrameTimingTest, TriggersAreLate) {
  FrameTimingConfig config;
  config.triggers = {{"right", -0.003}};
  const FrameTiming timing(config, {}, two_cameras(), 1);
  EXPECT_EQ(timing.instant(7, 0), timing.instant(7));
  EXPECT_EQ(timing.instant(7, 1), timing.instant(7) - 3'000'000);
  EXPECT_EQ(timing.longest_delay(), 3'000'000);
}

TEST(FrameTimingTest, StampsTellOfTriggersThatAreStamped) {
  FrameTimingConfig config;
  config.stamp_offset = 0.01;
  config.triggers = {{"right", -0.003, false}};
  EXPECT_TRUE(FrameTiming(config, {}, two_cameras(), 1).image_stamps(7).empty());
  config.triggers = {{"right", -0.003, true}};
  const FrameTiming timing(config, {}, two_cameras(), 1);
  const std::vector<Stamp> stamps = timing.image_stamps(7);
  ASSERT_EQ(stamps.size(), 2u);
  EXPECT_EQ(stamps[0], timing.stamp(7));
  EXPECT_EQ(stamps[1], timing.stamp(7) - 3'000'000);
  // At 15 Hz half of the time between frames is 33.3 ms.
  config.triggers = {{"left", 0.034, true}};
  EXPECT_THROW(FrameTiming(config, {}, two_cameras(), 1), Error);
  config.triggers[0].stamped = false;
  EXPECT_NO_THROW(FrameTiming(config, {}, two_cameras(), 1));
}

TEST(FrameTimingTest, RatesOfDrops) {
  FrameDropConfig drops;
  drops.camera_rate = 0.1;
  drops.frame_rate = 0.05;
  const FrameTiming timing({}, drops, two_cameras(), 1);
  int left = 0, both = 0;
  for (std::int64_t frame = 0; frame < kFrames; ++frame) {
    left += timing.is_dropped(frame, 0);
    both += timing.is_dropped(frame, 0) && timing.is_dropped(frame, 1);
  }
  // 0.05 + 0.95 * 0.1 and 0.05 + 0.95 * 0.01, each to four times sqrt(p (1 - p) / n).
  EXPECT_NEAR(left / double(kFrames), 0.145, 0.010);
  EXPECT_NEAR(both / double(kFrames), 0.0595, 0.0067);
}

TEST(FrameTimingTest, BurstsHitTheirCameraInTheirTime) {
  FrameDropConfig drops;
  drops.bursts = {{{"right"}, 1, 2.0}};
  const FrameTiming timing({}, drops, two_cameras(), 1);
  for (std::int64_t frame = 0; frame < 60; ++frame) {
    EXPECT_FALSE(timing.is_dropped(frame, 0));
    EXPECT_EQ(timing.is_dropped(frame, 1), frame >= 15 && frame < 30) << frame;
  }
}

TEST(FrameTimingTest, NonsenseIsRefused) {
  FrameTimingConfig config;
  config.stamp_jitter = 0.012;  // six of them are more than 1 / 15 s
  EXPECT_THROW(FrameTiming(config, {}, two_cameras(), 1), Error);
  config.stamp_jitter = 0;
  config.triggers = {{"nobody", 0.001}};
  EXPECT_THROW(FrameTiming(config, {}, two_cameras(), 1), Error);
}

}  // namespace
}  // namespace vinebench::sim
