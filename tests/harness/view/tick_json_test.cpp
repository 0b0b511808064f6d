// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/view/tick_json.h"

#include <gtest/gtest.h>

#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

using Json = nlohmann::ordered_json;

std::vector<Json> ticks_of(const test::FakeSlam::Change& change = {}) {
  const RunRecord record = test::record_of(change);
  TickJson ticks(record.rig, 0.8);
  std::vector<Json> list;
  for (const Tick& tick : record.ticks) list.push_back(ticks.of(tick));
  return list;
}

TEST(TickJsonTest, TheFirstEstimateLiesOnTheTruth) {
  const std::vector<Json> ticks = ticks_of();
  // A quarter of the circle in 5 s: (0, 1), heading west; the fake system's error is rounding.
  EXPECT_EQ(ticks[50]["t"], 5.0);
  EXPECT_EQ(ticks[50]["frame"], 50);
  EXPECT_NEAR(ticks[50]["live"][0].get<double>(), 0, 1e-4);
  EXPECT_NEAR(ticks[50]["live"][1].get<double>(), 1, 1e-4);
  EXPECT_EQ(ticks[50]["live"], ticks[50]["truth"]);
  EXPECT_EQ(ticks[50]["error"], 0.0);
  EXPECT_EQ(ticks[50]["status"], "t");
  EXPECT_EQ(ticks[50]["keyframe"], true);
  EXPECT_EQ(ticks[50]["inliers"], Json({80, 80, 0}));
  EXPECT_EQ(ticks[100]["occluded"], Json({0.95, 0.95, 0.0}));  // 10 s: behind the carton
}

TEST(TickJsonTest, AnErrorIsInMillimetres) {
  const std::vector<Json> ticks = ticks_of([](Estimate& estimate) {
    if (estimate.stamp == test::seconds(5)) estimate.T_map_body->translation.z() += 0.02;
  });
  EXPECT_EQ(ticks[50]["error"], 20.0);
}

TEST(TickJsonTest, WithoutAPoseThereIsNone) {
  const std::vector<Json> ticks = ticks_of([](Estimate& estimate) {
    if (estimate.stamp != test::seconds(5)) return;
    estimate.T_map_body.reset();
    estimate.status = TrackingStatus::kLost;
    estimate.keyframe = false;
  });
  EXPECT_EQ(ticks[50]["live"], nullptr);
  EXPECT_EQ(ticks[50]["error"], nullptr);
  EXPECT_EQ(ticks[50]["covariance"], nullptr);
  EXPECT_EQ(ticks[50]["status"], "l");
  EXPECT_EQ(ticks[50]["events"][0]["event"], "lost");
  EXPECT_EQ(ticks[51]["events"][0]["event"], "relocalised");
}

TEST(TickJsonTest, TheCovarianceIsInTheWorldsAxes) {
  const std::vector<Json> ticks = ticks_of(
      [](Estimate& estimate) { estimate.covariance.diagonal() << 1e-4, 4e-4, 9e-4, 0, 0, 0; });
  // At the start the body heads north: its x is the world's y.
  EXPECT_EQ(ticks[0]["covariance"][0], 4e-4);
  EXPECT_EQ(ticks[0]["covariance"][3], 1e-4);
  EXPECT_EQ(ticks[0]["covariance"][5], 9e-4);
}

TEST(TickJsonTest, ALoopIsNotJudgedYet) {
  const std::vector<Json> ticks = ticks_of([](Estimate& estimate) {
    if (estimate.stamp != test::seconds(19)) return;
    estimate.loop_closure = test::fake_closure(test::seconds(1), test::seconds(19));
  });
  const Json& loop = ticks[190]["events"].back();
  EXPECT_EQ(loop["event"], "loop_closure");
  EXPECT_EQ(loop["earlier_t"], 1.0);
  EXPECT_EQ(loop["correct"], nullptr);
}

}  // namespace
}  // namespace vinebench::harness
