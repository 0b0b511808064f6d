// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/mapping_scheduler.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <thread>

#include "slam/pipeline.h"
#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::angle;
using test::distance;
using test::SyntheticAisle;

MappingConfig config(MappingSchedule schedule, int delay = 0) {
  MappingConfig result;
  result.schedule = schedule;
  result.delay = delay;
  return result;
}

/// A map whose last keyframe is 1 cm off, which the job corrects.
class MappingSchedulerTest : public testing::Test {
 protected:
  MappingSchedulerTest() { known_.map.keyframe(2).T_map_body.translation.x() += 0.01; }

  static Pose truth(int keyframe) { return {exp_so3({0, 0, 0.02}), {0.1 * keyframe, 0, 0}}; }

  std::unique_ptr<AdjustmentJob> job() const {
    return std::make_unique<AdjustmentJob>(known_.map, AdjustmentWindow{{2}, {0, 1}}, known_.rig,
                                           AdjustmentOptions{});
  }

  SyntheticAisle aisle_{0, 1, 500};
  AisleMap known_{aisle_, {truth(0), truth(1), truth(2)}};
  StageTimes times_;
};

// Self-calibration may find offsets while a job is being solved: the job keeps the cameras that it
// was made with, so that its result does not depend on when that happens. Half a pixel at a
// disparity of 10 px is 5 % of the depth: with the new cameras the pose would move by centimetres.
TEST_F(MappingSchedulerTest, AJobKeepsTheCamerasThatItWasMadeWith) {
  Map undisturbed = known_.map;
  const auto alone = job();
  alone->solve();
  alone->apply(undisturbed);
  const auto beside = job();
  known_.rig = known_.rig.with_calibration({{{{}, 0.5}, {{}, 0.5}}, {}});
  beside->solve();
  beside->apply(known_.map);
  EXPECT_EQ(known_.map.keyframe(2).T_map_body.translation,
            undisturbed.keyframe(2).T_map_body.translation);
}

TEST_F(MappingSchedulerTest, HasNothingToJoinAtFirst) {
  MappingScheduler scheduler(config(MappingSchedule::kLockstep, 2));
  scheduler.tick();
  EXPECT_FALSE(scheduler.busy());
  EXPECT_FALSE(scheduler.due());
  const Pose before = known_.map.keyframe(2).T_map_body;
  EXPECT_EQ(scheduler.join(known_.map, times_).translation, Eigen::Vector3d::Zero());
  EXPECT_EQ(known_.map.keyframe(2).T_map_body.translation, before.translation);
  EXPECT_TRUE(times_.samples().empty());
}

TEST_F(MappingSchedulerTest, InLockstepIsDueAfterTheDelayHoweverSoonItIsSolved) {
  for (const int delay : {0, 1, 3}) {
    MappingScheduler scheduler(config(MappingSchedule::kLockstep, delay));
    scheduler.tick();  // ticks before the start do not count
    scheduler.start(job(), 2, known_.map);
    for (int frame = 0; frame < delay; ++frame) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));  // it is probably solved by now
      EXPECT_FALSE(scheduler.due()) << delay;
      scheduler.tick();
    }
    EXPECT_TRUE(scheduler.due()) << delay;
    EXPECT_TRUE(scheduler.busy());
    scheduler.join(known_.map, times_);
    EXPECT_FALSE(scheduler.busy());
    EXPECT_FALSE(scheduler.due());
  }
}

std::ptrdiff_t threads() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"),
                       std::filesystem::directory_iterator());
}

TEST_F(MappingSchedulerTest, TheCallerSolvesWithoutAnotherThread) {
  const std::ptrdiff_t before = threads();
  MappingScheduler scheduler(config(MappingSchedule::kLockstep, 2), true);
  scheduler.start(job(), 2, known_.map);
  EXPECT_EQ(threads(), before);
  EXPECT_FALSE(scheduler.due());  // it still joins after the delay
  scheduler.join(known_.map, times_);
  EXPECT_LT(distance(known_.map.keyframe(2).T_map_body, truth(2)), 1e-5);
}

TEST_F(MappingSchedulerTest, JoiningMovesTheMapAndTellsHowFar) {
  MappingScheduler scheduler(config(MappingSchedule::kLockstep, 2));
  const Pose before = known_.map.keyframe(2).T_map_body;
  scheduler.start(job(), 2, known_.map);
  EXPECT_EQ(known_.map.keyframe(2).T_map_body.translation, before.translation);  // not yet
  const Pose T_new_old = scheduler.join(known_.map, times_);
  const Pose& after = known_.map.keyframe(2).T_map_body;
  EXPECT_LT(distance(after, truth(2)), 1e-5);  // m, of the centimetre; six iterations
  EXPECT_LT(distance(T_new_old * before, after), 1e-12);
  EXPECT_LT(angle(T_new_old * before, after), 1e-7);  // the arc cosine's rounding
  ASSERT_EQ(times_.samples().count("local adjustment"), 1u);
  EXPECT_EQ(times_.samples().at("local adjustment").size(), 1u);
}

TEST_F(MappingSchedulerTest, LiveIsDueWhenItIsSolved) {
  MappingScheduler scheduler(config(MappingSchedule::kLive));
  scheduler.start(job(), 2, known_.map);
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!scheduler.due() && std::chrono::steady_clock::now() < patience) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(scheduler.due());  // without a tick
  scheduler.join(known_.map, times_);
  EXPECT_LT(distance(known_.map.keyframe(2).T_map_body, truth(2)), 1e-5);
}

// Before its first step a solver asks whether to go on.
TEST_F(MappingSchedulerTest, AStoppedJobEndsWithWhatItHasFoundByThen) {
  const auto stopped = job();
  const Pose before = known_.map.keyframe(2).T_map_body;
  stopped->stop();
  stopped->solve();
  stopped->apply(known_.map);
  EXPECT_LT(distance(known_.map.keyframe(2).T_map_body, before), 1e-12);
}

TEST_F(MappingSchedulerTest, AHastenedJobIsJoinedLikeAny) {
  MappingScheduler scheduler(config(MappingSchedule::kLive));
  scheduler.start(job(), 2, known_.map);
  scheduler.hasten();
  const Pose before = known_.map.keyframe(2).T_map_body;
  const Pose T_new_old = scheduler.join(known_.map, times_);
  EXPECT_LT(distance(T_new_old * before, known_.map.keyframe(2).T_map_body), 1e-12);
  EXPECT_LE(distance(known_.map.keyframe(2).T_map_body, truth(2)), 0.01 + 1e-12);
  EXPECT_FALSE(scheduler.busy());
}

/// Live and final poses of a drive, byte by byte. `pause` between two frames gives a job more or
/// less time.
std::string drive(const SyntheticAisle& aisle, int delay, std::chrono::milliseconds pause,
                  bool one_thread = false) {
  SlamConfig slam;
  slam.mapping = config(MappingSchedule::kLockstep, delay);
  Pipeline pipeline(slam, aisle.rig, {}, one_thread);
  std::string bytes;
  const auto append = [&](const Pose& pose) {
    bytes.append(reinterpret_cast<const char*>(pose.translation.data()), 3 * sizeof(double));
  };
  for (std::int64_t i = 0; i < 50; ++i) {
    const Pose truth{exp_so3({0, 0, 0.1}), {0.03 * static_cast<double>(i), 0, 0}};
    const Estimate estimate = pipeline.process(aisle.frame(i, truth));
    EXPECT_EQ(estimate.status, TrackingStatus::kTracking) << i;
    append(estimate.T_map_body.value_or(Pose{}));
    std::this_thread::sleep_for(pause);
  }
  for (const StampedPose& p : pipeline.finish().trajectory) append(p.pose);
  return bytes;
}

TEST(LockstepTest, TheResultIsTheSameWhateverTheThreadsDo) {
  const SyntheticAisle aisle(0.5, 7, 1500);
  for (const int delay : {0, 2, 5}) {
    const std::string hurried = drive(aisle, delay, std::chrono::milliseconds(0));
    EXPECT_EQ(hurried, drive(aisle, delay, std::chrono::milliseconds(10))) << delay;
    EXPECT_EQ(hurried, drive(aisle, delay, std::chrono::milliseconds(0), true)) << delay;
  }
}

TEST(LockstepTest, TheDelayIsPartOfTheConfiguration) {
  // The delay changes when tracking gets the result, and therefore the bytes; otherwise the test
  // above would prove nothing.
  const SyntheticAisle aisle(0.5, 7, 1500);
  EXPECT_NE(drive(aisle, 0, std::chrono::milliseconds(0)),
            drive(aisle, 5, std::chrono::milliseconds(0)));
}

}  // namespace
}  // namespace vinebench::slam
