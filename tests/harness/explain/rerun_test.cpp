// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/rerun.h"

#include <gtest/gtest.h>

#include "tests/support/court_scenario.h"

namespace vinebench::harness {
namespace {

using RerunTest = test::CourtScenario;

TEST_F(RerunTest, SurvivesItsMessage) {
  Rerun rerun{.same_drive = false, .seconds = 2.5};
  const Pose pose{from_roll_pitch_yaw({0.1, 0.2, 0.3}), {1, 2, 3}};
  rerun.steps.push_back({.index = 4, .stamp = 5, .T_world_body = pose});
  rerun.steps.push_back(
      {.index = 5, .stamp = 6, .T_world_body = {}, .T_map_body = pose, .tracked = true});
  const Rerun received = unpack_rerun(pack_rerun(rerun));
  EXPECT_EQ(pack_rerun(received), pack_rerun(rerun));
  EXPECT_FALSE(received.same_drive);
  EXPECT_EQ(received.seconds, 2.5);
  ASSERT_EQ(received.steps.size(), 2u);
  EXPECT_FALSE(received.steps[0].T_map_body.has_value());
  EXPECT_EQ(received.steps[1].T_map_body->rotation.coeffs(), pose.rotation.coeffs());
  EXPECT_TRUE(received.steps[1].tracked);
}

// The same estimator's state, the same frames: the same poses to the bit, by either way.
TEST_F(RerunTest, GoesOnWithTheEstimatorThatItIsGiven) {
  write_large_rig();
  const Rerun whole = run_variant({scenario()}, {}, kFrames - 1, machine(), {});
  ASSERT_EQ(whole.steps.size(), static_cast<std::size_t>(kFrames));
  EXPECT_GT(whole.seconds, 0);

  WorkerPool pool(1);
  VariantDrive drive({scenario()}, {}, 2, machine(), pool);
  const auto slam = slam::make_slam(scenario().slam, drive.rig(), {}, pool);
  Splice splice;
  while (const auto sample = drive.next()) {
    slam->process(sample->frame);
    splice = {sample->frame.index + 1, sample->frame.stamp, sample->truth.path.back()};
  }
  const Rerun rest =
      run_variant({scenario()}, splice, kFrames - 1, machine(), {.slam = slam.get()});
  EXPECT_TRUE(rest.same_drive);
  ASSERT_EQ(rest.steps.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Step& expected = whole.steps[i + 3];
    EXPECT_EQ(rest.steps[i].index, expected.index);
    ASSERT_EQ(rest.steps[i].T_map_body.has_value(), expected.T_map_body.has_value());
    if (!expected.T_map_body) continue;
    EXPECT_EQ(rest.steps[i].T_map_body->translation, expected.T_map_body->translation) << i;
  }
  EXPECT_TRUE(whole.steps.back().tracked);
}

TEST_F(RerunTest, StopsWhereTheDriveIsAnotherOne) {
  Splice splice{3, from_seconds(2.0 / 15), StampedPose{0, {}}};
  splice.path_end->pose.translation.x() = 1;
  const Rerun rerun = run_variant({scenario()}, splice, kFrames - 1, machine(), {});
  EXPECT_FALSE(rerun.same_drive);
  EXPECT_TRUE(rerun.steps.empty());
}

}  // namespace
}  // namespace vinebench::harness
