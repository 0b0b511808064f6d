// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/occlusion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fakes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

/// Four seconds east at 0.5 m/s, 10 frames a second, 100 inliers in each of two cameras.
RunRecord clear_drive() {
  RunRecord record;
  record.rig = test::fake_rig();
  for (std::int64_t i = 0; i <= 40; ++i) {
    Tick tick;
    tick.index = i;
    tick.stamp = stamp_of_frame(i, 10);
    tick.truth.T_world_body.translation.x() = 0.05 * static_cast<double>(i);
    tick.truth.occlusion.resize(3);
    tick.estimate.status = TrackingStatus::kTracking;
    tick.estimate.T_map_body = tick.truth.T_world_body;
    tick.estimate.cameras = {{500, 200, 100, 100}, {500, 200, 100, 100}, {}};
    record.ticks.push_back(tick);
  }
  return record;
}

TEST(LongestOcclusionTest, ClassesAddUpAndTheLargestIsNamed) {
  RunRecord record = clear_drive();
  EXPECT_FALSE(longest_occlusion(record, {0, 1}, 0.8));
  for (std::size_t i = 10; i <= 30; ++i) {
    for (const std::size_t camera : {0, 1}) {
      // 0.9 together; neither class alone would blind the camera.
      record.ticks[i].truth.occlusion[camera].share(OccluderClass::kPerson) = 0.5;
      record.ticks[i].truth.occlusion[camera].share(OccluderClass::kCrate) = 0.4;
      record.ticks[i].estimate.cameras[camera].inliers = 10;
    }
  }
  const auto blind = longest_occlusion(record, {0, 1}, 0.8);
  ASSERT_TRUE(blind);
  EXPECT_EQ(blind->first, 10u);
  EXPECT_EQ(blind->last, 30u);
  EXPECT_NEAR(blind->seconds, 2, 1e-9);
  EXPECT_NEAR(blind->metres, 1, 1e-9);
  EXPECT_EQ(blind->occluder, OccluderClass::kPerson);
  EXPECT_NEAR(*blind->inliers_drop(), 0.9, 1e-9);  // 20 of 200 are left
}

TEST(LongestOcclusionTest, StandingStillDoesNotCount) {
  RunRecord record = clear_drive();
  for (Tick& tick : record.ticks) {
    tick.truth.T_world_body.translation.setZero();
    for (Occlusion& seen : tick.truth.occlusion) seen.share(OccluderClass::kCarton) = 1;
  }
  EXPECT_FALSE(longest_occlusion(record, {0}, 0.8));
}

TEST(FindCamerasTest, AnUnknownNameIsAnError) {
  EXPECT_THAT(test::error_of([] { find_cameras(test::fake_rig(), {"roof"}); }),
              testing::HasSubstr("no camera 'roof'"));
}

}  // namespace
}  // namespace vinebench::harness
