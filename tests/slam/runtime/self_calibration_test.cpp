// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/runtime/self_calibration.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "slam/stereo/stereo_matcher.h"
#include "tests/support/aisle_map.h"
#include "tests/support/winding_drive.h"

namespace vinebench::slam {
namespace {

using Found = std::optional<RigCalibration>;

/// A drive with a back pair whose disparities are 0.5 px too small.
class SelfCalibrationTest : public testing::Test {
 protected:
  SelfCalibrationTest() {
    for (double& scale : made_.rig.noise.level_scales) scale *= 0.3;
    aisle_.calibration[1].disparity_offset = -0.5;
  }

  void add_keyframe() {
    const auto id = static_cast<int>(made_.map.keyframes().size());
    aisle_.velocity = test::winding_velocity(id);
    made_.add(aisle_.frame(id, test::winding(id)), test::winding(id));
  }
  Found look(SelfCalibration& calibration) {
    return calibration.after_keyframe(made_.map, made_.rig, {}, times_);
  }
  std::size_t looks_timed() const {
    const auto samples = times_.samples().find("calibration");
    return samples == times_.samples().end() ? 0 : samples->second.size();
  }

  test::SyntheticAisle aisle_{0.3, 4, 800};
  test::AisleMap made_{aisle_, {}};
  StageTimes times_;
};

// What tags are good for says nothing of the pairs.
TEST(AccuracyTest, IsToldWhereANumberOfThePairsIsNotTheUsualOne) {
  const double usual = StereoConfig{}.calibration_sigma;
  EXPECT_FALSE(is_accuracy_told({}, usual));
  EXPECT_TRUE(is_accuracy_told({}, 0.5 * usual));
  EXPECT_TRUE(is_accuracy_told({.focal = 0.001}, usual));
  EXPECT_TRUE(is_accuracy_told({.right_ahead = 0.001}, usual));
  EXPECT_TRUE(is_accuracy_told({.tag_camera_position = 0.001}, usual));
  EXPECT_TRUE(is_accuracy_told({.tag_camera_rotation_deg = 0.05}, usual));
  EXPECT_FALSE(is_accuracy_told({.tag_size = 0.01}, usual));
}

TEST_F(SelfCalibrationTest, SwitchedOffItNeverLooks) {
  SelfCalibration calibration({.enabled = false}, made_.rig);
  for (int i = 0; i < 24; ++i) {
    add_keyframe();
    EXPECT_FALSE(look(calibration));
  }
  EXPECT_EQ(calibration.error().size(), 0);
  EXPECT_EQ(looks_timed(), 0u);
}

// At first it is the file's accuracy, which a look makes better.
TEST_F(SelfCalibrationTest, TheErrorIsKnownBeforeTheFirstLook) {
  SelfCalibration calibration({}, made_.rig);
  const CalibrationWatch watch({}, 1, made_.rig);
  EXPECT_EQ(calibration.error(), watch.error(made_.rig));
  const double before = calibration.error().trace();
  for (int i = 0; i < 12; ++i) {
    add_keyframe();
    if (const Found found = look(calibration)) made_.rig = made_.rig.with_calibration(*found);
  }
  EXPECT_LT(calibration.error().trace(), before);
}

// Of the same map and rig a look finds the same, wherever it is made; beside tracking no call waits
// for it, so that it is there with a later one.
TEST_F(SelfCalibrationTest, BesideTrackingItFindsTheSameLater) {
  SelfCalibration at_once({}, made_.rig), beside({.beside_tracking = true}, made_.rig);
  Found first;
  for (int i = 0; i < 36 && !first; ++i) {
    add_keyframe();
    first = look(at_once);
    Found later = look(beside);
    EXPECT_FALSE(later);
    // Without another keyframe no further look begins.
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (first && !later && std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      later = look(beside);
    }
    if (!first) {
      beside.finish();
      continue;
    }
    ASSERT_TRUE(later);
    EXPECT_EQ(later->pairs[1].disparity_offset, first->pairs[1].disparity_offset);
    EXPECT_EQ(beside.error(), at_once.error());
  }
  ASSERT_TRUE(first);
  // As CalibrationWatchTest has it for the same offset.
  EXPECT_NEAR(first->pairs[1].disparity_offset, -0.5, 0.1);
  EXPECT_EQ(at_once.latest()->pairs[1].disparity_offset, first->pairs[1].disparity_offset);
}

}  // namespace
}  // namespace vinebench::slam
