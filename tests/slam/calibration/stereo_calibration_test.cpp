// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/calibration/stereo_calibration.h"

#include <gtest/gtest.h>

#include "slam/frame/measurements.h"
#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::SyntheticAisle;

/// Poses of a drive of 2.4 m.
std::vector<Pose> drive() {
  std::vector<Pose> poses;
  for (int i = 0; i < 12; ++i) {
    poses.push_back({exp_so3({0, 0, 0.02 * i}), {0.2 * i, 0.01 * i, 0}});
  }
  return poses;
}

/// A map whose second pair measures disparities too small by `offset` px, by `later` px from the
/// middle of the drive on, with landmarks at the resulting positions.
AisleMap map_with_offsets(const SyntheticAisle& aisle, double offset, double later) {
  AisleMap made(aisle, {});
  const StereoCameraModel& camera = made.rig.left_cameras[1];
  for (const Pose& pose : drive()) {
    const auto index = static_cast<std::int64_t>(made.map.keyframes().size());
    auto frame = aisle.frame(index, pose);
    const double wrong = index < 6 ? offset : later;
    StereoView& view = frame->views[1];
    for (std::size_t f = 0; f < view.stereo.size(); ++f) {
      StereoMatch& match = view.stereo[f];
      match.x_right += static_cast<float>(wrong);
      match.depth = static_cast<float>(
          camera.depth_of(static_cast<double>(view.features.keypoints[f].x - match.x_right)));
    }
    made.add(frame, pose);
  }
  for (Landmark& landmark : made.map.landmarks()) {
    const Observation& o = landmark.observations.front();
    const Keyframe& keyframe = made.map.keyframe(o.keyframe);
    landmark.position =
        stereo_point(keyframe.frame->views[static_cast<std::size_t>(o.view)], o.feature,
                     made.rig.left_cameras[static_cast<std::size_t>(o.view)].lens,
                     keyframe.T_map_body, made.rig.T_body_cams[static_cast<std::size_t>(o.view)]);
  }
  return made;
}

AisleMap map_with_offset(const SyntheticAisle& aisle, double offset) {
  return map_with_offsets(aisle, offset, offset);
}

// Pixels are stored as floats, to 3e-5 px; the offset is tied to thousands of them.
TEST(StereoCalibrationTest, FindsTheOffsetOfAPair) {
  const SyntheticAisle aisle(0, 1, 800);
  const AisleMap made = map_with_offset(aisle, 0.8);
  const auto offsets = find_disparity_offsets(made.map, made.rig, {});
  ASSERT_TRUE(offsets);
  EXPECT_NEAR((*offsets)[0], 0, 1e-3);
  EXPECT_NEAR((*offsets)[1], 0.8, 1e-3);
}

// Half a pixel of noise in thousands of pixels: a hundredth of a pixel, five times that at most.
TEST(StereoCalibrationTest, FindsItAmongNoise) {
  const SyntheticAisle aisle(0.5, 2, 800);
  const AisleMap made = map_with_offset(aisle, -0.5);
  const auto offsets = find_disparity_offsets(made.map, made.rig, {});
  ASSERT_TRUE(offsets);
  EXPECT_NEAR((*offsets)[0], 0, 0.05);
  EXPECT_NEAR((*offsets)[1], -0.5, 0.05);
}

TEST(StereoCalibrationTest, ARightCalibrationStays) {
  const SyntheticAisle aisle(0.5, 3, 800);
  const AisleMap made = map_with_offset(aisle, 0);
  EXPECT_FALSE(find_disparity_offsets(made.map, made.rig, {}));
}

// Twelve keyframes, of which the later six measure otherwise: on the whole drive that looks like an
// offset of about a pixel, which no half of it has.
TEST(StereoCalibrationTest, WhatChangesOnTheWayIsNoCalibration) {
  const SyntheticAisle aisle(0.5, 2, 800);
  const AisleMap changing = map_with_offsets(aisle, 2.4, 0);
  EXPECT_FALSE(find_disparity_offsets(changing.map, changing.rig, {}));
  const AisleMap steady = map_with_offset(aisle, 1.2);
  EXPECT_TRUE(find_disparity_offsets(steady.map, steady.rig, {}));
}

// Three standard deviations of the calibration's accuracy are the limit: 3 px, 6 px.
TEST(StereoCalibrationTest, MoreThanTheRigsAccuracyAllowsIsNotBelieved) {
  const SyntheticAisle aisle(0.5, 2, 800);
  AisleMap made = map_with_offset(aisle, 3.5);
  EXPECT_FALSE(find_disparity_offsets(made.map, made.rig, {}));
  made.rig.noise.disparity_offset_sigma = 2;
  const auto offsets = find_disparity_offsets(made.map, made.rig, {});
  ASSERT_TRUE(offsets);
  EXPECT_NEAR((*offsets)[1], 3.5, 0.05);
}

// The search starts from the previous result and finds no further offset.
TEST(StereoCalibrationTest, WhatIsKnownIsNotFoundAgain) {
  const SyntheticAisle aisle(0, 1, 800);
  AisleMap made = map_with_offset(aisle, 0.8);
  made.rig = made.rig.with_disparity_offsets({0, 0.8});
  EXPECT_FALSE(find_disparity_offsets(made.map, made.rig, {}));
}

TEST(StereoCalibrationTest, IsDueAtTwelveKeyframesAndEachTimeTheyHaveDoubled) {
  Map map(1.2);
  std::vector<int> due;
  for (int i = 1; i < 400; ++i) {
    map.add_keyframe(std::make_shared<FrameFeatures>(), {}, {});
    if (calibration_due(map)) due.push_back(i);
  }
  EXPECT_EQ(due, (std::vector<int>{12, 24, 48, 96}));
}

}  // namespace
}  // namespace vinebench::slam
