// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/live_slam.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <semaphore>

#include "core/util/error.h"
#include "slam/pipeline.h"
#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::angle;
using test::distance;
using test::SyntheticAisle;

/// Processes a frame when the test allows it, and records its input.
class HeldSystem : public SlamSystem {
 public:
  Estimate process(const Frame& frame) override {
    begun.release();
    allowed.acquire();
    if (frame.index == bad_frame) fail("frame {} is bad", frame.index);
    frames.push_back(frame);
    Estimate estimate;
    estimate.stamp = frame.stamp;
    return estimate;
  }
  SlamSummary finish() override { return {{}, {}, frames.size()}; }
  const StageTimes& times() const override { return times_; }

  std::counting_semaphore<1000> begun{0};
  std::counting_semaphore<1000> allowed{0};
  std::vector<Frame> frames;
  std::int64_t bad_frame = -1;

 private:
  StageTimes times_;
};

Frame frame(std::int64_t index) {
  Frame result;
  result.index = index;
  result.stamp = stamp_of_frame(index, 15);
  result.imu.resize(1);
  result.imu[0].stamp = result.stamp;
  return result;
}

TEST(LiveSlamTest, TheNewestFrameIsWorkedOnAndOthersAreCounted) {
  HeldSystem system;
  std::vector<Stamp> answered;
  LiveSlam live(system, [&](const Estimate& estimate) { answered.push_back(estimate.stamp); });
  live.push(frame(0));
  system.begun.acquire();  // frame 0 is being processed
  for (std::int64_t i = 1; i <= 4; ++i) live.push(frame(i));
  EXPECT_EQ(live.dropped(), 3);  // 1, 2 and 3 in favour of 4
  system.allowed.release(2);
  system.begun.acquire();  // frame 4 is being processed
  system.allowed.release(1);
  live.push(frame(5));
  const SlamSummary summary = live.finish();
  EXPECT_EQ(live.dropped(), 3);
  EXPECT_EQ(summary.landmarks, 3u);
  EXPECT_THAT(answered, testing::ElementsAre(frame(0).stamp, frame(4).stamp, frame(5).stamp));
  // Inertial samples of dropped frames are not lost.
  ASSERT_EQ(system.frames[1].imu.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(system.frames[1].imu[i].stamp, frame(static_cast<std::int64_t>(i) + 1).stamp);
  }
  EXPECT_EQ(system.frames[2].imu.size(), 1u);
}

TEST(LiveSlamTest, AnErrorComesOutOfTheNextPushAndOfFinish) {
  HeldSystem system;
  system.bad_frame = 0;
  LiveSlam live(system, {});
  live.push(frame(0));
  system.begun.acquire();  // or the next frame might take its place
  system.allowed.release(1);
  const auto message = testing::ThrowsMessage<Error>("frame 0 is bad");
  // The thread needs a while to fail; until then frames are taken.
  const auto push_until_it_throws = [&] {
    for (;;) {
      live.push(frame(1));
      std::this_thread::yield();
    }
  };
  EXPECT_THAT(push_until_it_throws, message);
  EXPECT_THAT([&] { live.push(frame(2)); }, message);
  EXPECT_THAT([&] { live.finish(); }, message);
}

TEST(LiveSlamTest, AnErrorInTheLastFrameComesOutOfFinish) {
  HeldSystem system;
  system.bad_frame = 1;
  LiveSlam live(system, {});
  live.push(frame(0));
  system.begun.acquire();
  live.push(frame(1));
  system.allowed.release(2);
  EXPECT_THAT([&] { live.finish(); }, testing::ThrowsMessage<Error>("frame 1 is bad"));
}

TEST(LiveSlamTest, AnErrorOfTheListenerComesOutToo) {
  HeldSystem system;
  system.allowed.release(1);
  LiveSlam live(system, [](const Estimate&) { fail("no room"); });
  live.push(frame(0));
  EXPECT_THAT([&] { live.finish(); }, testing::ThrowsMessage<Error>("no room"));
}

TEST(LiveSlamTest, TakesNothingAfterFinish) {
  HeldSystem system;
  LiveSlam live(system, {});
  EXPECT_EQ(live.finish().landmarks, 0u);
  const auto message = testing::ThrowsMessage<Error>(testing::HasSubstr("after finish()"));
  EXPECT_THAT([&] { live.push(frame(0)); }, message);
  EXPECT_THAT([&] { live.finish(); }, message);
}

TEST(LiveSlamTest, EndsWithoutFinish) {
  HeldSystem system;
  {
    LiveSlam live(system, {});
    live.push(frame(0));
    system.begun.acquire();
    live.push(frame(1));
    system.allowed.release(2);  // the thread may have taken up frame 1 before it is asked to end
  }
  EXPECT_LE(system.frames.size(), 2u);
  EXPECT_EQ(system.frames.at(0).index, 0);
}

/// The core without feature extraction as a SlamSystem in the aisle. Each frame needs a permit, so
/// that the test controls how many frames arrive meanwhile.
class AisleSystem : public SlamSystem {
 public:
  AisleSystem(const SlamConfig& config, const SyntheticAisle& aisle)
      : aisle_(aisle), pipeline_(config, aisle.rig, {}) {}

  /// 0.3 m/s along the aisle at 15 frames a second, swaying in heading.
  static Pose truth(std::int64_t index) {
    const double x = 0.02 * static_cast<double>(index);
    return {exp_so3({0, 0, 0.1 * std::sin(2.0 * x)}), {x, 0.05 * std::sin(x), 0}};
  }

  Estimate process(const Frame& frame) override {
    begun.release();
    allowed.acquire();
    return pipeline_.process(aisle_.frame(frame.index, truth(frame.index)));
  }
  SlamSummary finish() override { return pipeline_.finish(); }
  const StageTimes& times() const override { return pipeline_.times(); }

  std::counting_semaphore<1000> begun{0};
  std::counting_semaphore<1000> allowed{0};

 private:
  const SyntheticAisle& aisle_;
  Pipeline pipeline_;
};

constexpr std::int64_t kFrames = 150;

/// Every third frame takes so long that of the three that arrive meanwhile two are dropped.
SlamSummary drive_live(const SyntheticAisle& aisle, std::int64_t& dropped) {
  SlamConfig config;
  config.mapping.schedule = MappingSchedule::kLive;
  AisleSystem system(config, aisle);
  LiveSlam live(system, [](const Estimate& estimate) {
    EXPECT_EQ(estimate.status, TrackingStatus::kTracking) << estimate.stamp;
  });
  live.push(frame(0));
  for (std::int64_t i = 1, worked_on = 1; i < kFrames; ++worked_on) {
    system.begun.acquire();
    const std::int64_t meanwhile = worked_on % 3 == 0 ? 3 : 1;
    for (const std::int64_t end = std::min(kFrames, i + meanwhile); i < end; ++i) {
      live.push(frame(i));
    }
    system.allowed.release();
  }
  system.allowed.release(2);
  SlamSummary summary = live.finish();
  dropped = live.dropped();
  return summary;
}

SlamSummary drive_in_lockstep(const SyntheticAisle& aisle) {
  AisleSystem system(SlamConfig{}, aisle);
  system.allowed.release(kFrames);
  for (std::int64_t i = 0; i < kFrames; ++i) system.process(frame(i));
  return system.finish();
}

TEST(LiveSlamTest, StaysNearTheLockstepResult) {
  const SyntheticAisle aisle(0.5, 2, 1500);
  const SlamSummary lockstep = drive_in_lockstep(aisle);
  std::int64_t dropped = 0;
  const SlamSummary live = drive_live(aisle, dropped);
  // Of every five frames pushed two are dropped.
  EXPECT_NEAR(static_cast<double>(dropped), 2.0 / 5 * kFrames, 2);
  ASSERT_EQ(live.trajectory.size(), static_cast<std::size_t>(kFrames - dropped));
  ASSERT_EQ(lockstep.trajectory.size(), static_cast<std::size_t>(kFrames));
  // Each drifts from the truth by about 0.1 % of 3 m, 3 mm, in its own direction: when mapping
  // joins and which frames become keyframes differs.
  std::size_t i = 0;
  for (const StampedPose& pose : live.trajectory) {
    while (lockstep.trajectory.at(i).stamp < pose.stamp) ++i;
    ASSERT_EQ(lockstep.trajectory[i].stamp, pose.stamp);
    EXPECT_LT(distance(pose.pose, lockstep.trajectory[i].pose), 0.006) << i;  // m
    EXPECT_LT(angle(pose.pose, lockstep.trajectory[i].pose), 0.003) << i;     // rad
  }
}

}  // namespace
}  // namespace vinebench::slam
