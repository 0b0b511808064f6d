// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/degraded_segments.h"

#include <gtest/gtest.h>

#include "tests/support/steady_drive.h"

namespace vinebench::harness {
namespace {

class DegradedSegmentsTest : public test::SteadyDrive {
 protected:
  std::vector<DegradedSegment> found() const {
    return degraded_segments(record_, measure(record_, {}));
  }
};

TEST_F(DegradedSegmentsTest, ASteadyDriveHasNone) {
  EXPECT_TRUE(found().empty());
  EXPECT_TRUE(degraded_segments({}, {}).empty());
}

TEST_F(DegradedSegmentsTest, FramesWithoutAPoseAreOne) {
  meanwhile([](Tick& tick) {
    tick.estimate.status = TrackingStatus::kLost;
    tick.estimate.T_map_body.reset();
    tick.estimate.cameras = {};
  });
  const auto segments = found();
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_EQ(segments[0].first, 100u);
  EXPECT_EQ(segments[0].last, 120u);
  EXPECT_EQ(segments[0].untracked, 21);
  EXPECT_EQ(segments[0].inliers, 0);
  EXPECT_EQ(segments[0].usual_inliers, 180);  // 90 of each front camera
  EXPECT_NEAR(segments[0].error_growth, 0, 1e-12);
}

TEST_F(DegradedSegmentsTest, FramesBeforeTheFirstPoseAreNone) {
  for (std::size_t i = 0; i < 20; ++i) {
    record_.ticks[i].estimate.status = TrackingStatus::kInitializing;
    record_.ticks[i].estimate.T_map_body.reset();
  }
  EXPECT_TRUE(found().empty());
}

// A third of the usual 180 inliers is 60.
TEST_F(DegradedSegmentsTest, WeakTrackingIsBelowAThirdOfTheUsualInliers) {
  meanwhile(
      [](Tick& tick) { tick.estimate.cameras[0].inliers = tick.estimate.cameras[1].inliers = 30; });
  EXPECT_TRUE(found().empty());
  meanwhile([](Tick& tick) { tick.estimate.cameras[1].inliers = 29; });
  EXPECT_EQ(found().size(), 1u);
}

// Of ticks 100 to 105 and 110 to 115 the gap is 0.5 s; from 111 on it is 0.6 s.
TEST_F(DegradedSegmentsTest, ShortGapsAreBridged) {
  for (std::size_t i = 100; i <= 115; ++i) {
    if (i <= 105 || i >= 110) test::weaken(record_.ticks[i]);
  }
  const auto bridged = found();
  ASSERT_EQ(bridged.size(), 1u);
  EXPECT_EQ(bridged[0].last, 115u);
  EXPECT_DOUBLE_EQ(bridged[0].inliers, (12 * 20 + 4 * 180) / 16.0);
  record_.ticks[110].estimate.cameras = record_.ticks[99].estimate.cameras;
  const auto apart = found();
  ASSERT_EQ(apart.size(), 2u);
  EXPECT_EQ(apart[0].last, 105u);
  EXPECT_EQ(apart[1].first, 111u);
}

TEST_F(DegradedSegmentsTest, AnErrorThatGrowsFastIsOne) {
  slide();
  const auto segments = found();
  ASSERT_EQ(segments.size(), 1u);
  // Seconds that end from 10.2 s (10 mm of growth; 7.5 mm are 1.5 % of 0.5 m) to 12.8 s are fast;
  // they begin one second earlier.
  EXPECT_NEAR(static_cast<double>(segments[0].first), 93, 1);
  EXPECT_NEAR(static_cast<double>(segments[0].last), 128, 1);
  EXPECT_NEAR(segments[0].error_growth, 0.1, 1e-9);
}

TEST_F(DegradedSegmentsTest, WithoutTruthThereIsNone) {
  meanwhile(test::weaken);
  for (Tick& tick : record_.ticks) tick.truth.known = false;
  EXPECT_TRUE(found().empty());
}

TEST_F(DegradedSegmentsTest, TheTrueMotionIsThatOfTheBody) {
  for (const std::size_t tick : {std::size_t{0}, std::size_t{50}, std::size_t{200}}) {
    EXPECT_NEAR(true_motion(record_, tick).speed, 0.5, 1e-9) << tick;  // m/s
    EXPECT_NEAR(true_motion(record_, tick).turn, 0, 1e-9) << tick;
  }
  // A quarter turn within the 0.2 s from the tick before to the one after.
  record_.ticks[51].truth.T_world_body.rotation = exp_so3({0, 0, std::numbers::pi / 2});
  EXPECT_NEAR(true_motion(record_, 50).turn, std::numbers::pi / 2 / 0.2, 1e-9);  // rad/s
  record_.ticks[51].truth.known = false;
  EXPECT_EQ(true_motion(record_, 50).speed, 0);
}

// The map is turned by a quarter to the left against the world: the drift is given in the world.
TEST_F(DegradedSegmentsTest, ErrorGrowthIsADriftInTheWorld) {
  const Pose T_map_world{exp_so3({0, 0, std::numbers::pi / 2}), {7, 8, 9}};
  for (Tick& tick : record_.ticks)
    tick.estimate.T_map_body = T_map_world * *tick.estimate.T_map_body;
  record_.ticks[30].estimate.T_map_body->translation.x() -= 0.2;  // -x of the map is y of the world
  const auto growth = error_growth(record_, 20, 30);
  ASSERT_TRUE(growth);
  EXPECT_LT((*growth - Eigen::Vector3d(0, 0.2, 0)).norm(), 1e-12);
  record_.ticks[30].estimate.T_map_body.reset();
  EXPECT_FALSE(error_growth(record_, 20, 30));
}

}  // namespace
}  // namespace vinebench::harness
