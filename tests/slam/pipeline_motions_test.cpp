// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

/// The pipeline through motions that are hard for one reason each: a turn on the spot, a minute's
/// rest, half a second in the dark; and with rigs of one, two and three pairs.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slam/pipeline.h"
#include "tests/slam/aisle_map.h"
#include "tests/slam/rigs.h"

namespace vinebench {
namespace {

using testing_support::angle;
using testing_support::distance;
using testing_support::rig_of_pairs;
using testing_support::SyntheticAisle;

SyntheticAisle make_aisle(double noise, std::uint64_t seed, int landmarks, std::size_t pairs = 2) {
  SyntheticAisle aisle(noise, seed, landmarks);
  aisle.rig = rig_of_pairs(aisle.rig, pairs);
  return aisle;
}

/// Greatest distance, m, and angle, rad, to the truth; both seen from their first pose.
struct WorstError {
  double position = 0;
  double turn = 0;
};

WorstError worst_error(const Trajectory& estimate, const std::vector<Pose>& truth) {
  WorstError worst;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const Pose moved = estimate.front().pose.inverse() * estimate[i].pose;
    const Pose moved_truth = truth.front().inverse() * truth[i];
    worst.position = std::max(worst.position, distance(moved, moved_truth));
    worst.turn = std::max(worst.turn, angle(moved, moved_truth));
  }
  return worst;
}

/// Runs all frames; every one must be tracked.
WorstError drive(const SyntheticAisle& aisle, const std::vector<Pose>& truth,
                 std::size_t* keyframes = nullptr) {
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Estimate estimate = pipeline.process(aisle.frame(static_cast<std::int64_t>(i), truth[i]));
    EXPECT_EQ(estimate.status, TrackingStatus::kTracking) << i;
  }
  const SlamSummary summary = pipeline.finish();
  EXPECT_EQ(summary.trajectory.size(), truth.size());
  if (keyframes != nullptr) *keyframes = summary.keyframes.size();
  return worst_error(summary.trajectory, truth);
}

/// Along the aisle at `speed`, 15 frames a second, swaying in heading.
Pose driving(std::int64_t frame, double speed) {
  const double x = speed / 15 * static_cast<double>(frame);
  return {exp_so3({0, 0, 0.1 * std::sin(2.0 * x)}), {x, 0.05 * std::sin(x), 0}};
}

class RigOfPairsTest : public testing::TestWithParam<std::size_t> {};

TEST_P(RigOfPairsTest, RecoversTheWayExactlyWithoutNoise) {
  const SyntheticAisle aisle = make_aisle(0, 1, 3000, GetParam());
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 45; ++i) truth.push_back(driving(i, 0.3));
  const WorstError worst = drive(aisle, truth);
  // Pixels are held as floats, 3e-5 px at 500: about 1e-7 m a keyframe at half a metre.
  EXPECT_LT(worst.position, 2e-6);
  EXPECT_LT(worst.turn, 2e-6);
}

TEST_P(RigOfPairsTest, DriftsLittleWithNoise) {
  const SyntheticAisle aisle = make_aisle(0.5, 2, 3000, GetParam());
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 90; ++i) truth.push_back(driving(i, 0.3));
  const WorstError worst = drive(aisle, truth);
  // Half a pixel at half a metre is 1 mm for one feature, 0.06 mm for 300; over some ten keyframes
  // and with the lever of their headings ten times that, and a margin of three.
  EXPECT_LT(worst.position, 0.006);
  EXPECT_LT(worst.turn, 0.006);
}

INSTANTIATE_TEST_SUITE_P(Pairs, RigOfPairsTest, testing::Values(1, 2, 3));

TEST(PipelineMotionsTest, TurnsOnTheSpot) {
  // A full turn and a half at 30 degrees a second: there is no parallax but the stereo pairs' own.
  std::vector<Pose> truth;
  for (int i = 0; i < 270; ++i) {
    truth.push_back({exp_so3({0, 0, 2.0 * i * std::numbers::pi / 180}), {0.1, 0.02, 0}});
  }
  const WorstError exact = drive(make_aisle(0, 3, 1500), truth);
  EXPECT_LT(exact.position, 1e-5);  // m; floats, as above, over 30 keyframes
  EXPECT_LT(exact.turn, 1e-5);      // rad
  // A keyframe's own heading is good to 0.5 px / 263 px / sqrt(300) = 0.1 mrad; 30 of them.
  const WorstError noisy = drive(make_aisle(0.5, 3, 1500), truth);
  EXPECT_LT(noisy.position, 0.003);
  EXPECT_LT(noisy.turn, 0.003);
}

TEST(PipelineMotionsTest, StandsStillForAMinute) {
  std::size_t keyframes = 0;
  const std::vector<Pose> truth(900, driving(10, 0.3));
  const WorstError worst = drive(make_aisle(0.5, 4, 900), truth, &keyframes);
  EXPECT_LT(worst.position, 0.001);  // m
  EXPECT_LT(worst.turn, 0.001);      // rad
  EXPECT_LE(keyframes, 2u);
}

TEST(PipelineMotionsTest, FindsItsWayAfterHalfASecondInTheDark) {
  // 0.4 m/s; eight frames are dark, 0.53 s and 0.21 m.
  const SyntheticAisle aisle = make_aisle(0.5, 5, 1500);
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 90; ++i) {
    const Pose pose = driving(i, 0.4);
    const bool dark = i >= 40 && i < 48;
    const Estimate estimate =
        pipeline.process(dark ? aisle.frame(i, pose, {0, 1}) : aisle.frame(i, pose));
    if (dark) {
      EXPECT_EQ(estimate.status, TrackingStatus::kLost) << i;
    } else {
      EXPECT_EQ(estimate.status, TrackingStatus::kTracking) << i;
    }
    if (estimate.status == TrackingStatus::kTracking) truth.push_back(pose);
  }
  // No silent jump: every frame that has a pose is as good as without the dark.
  const SlamSummary summary = pipeline.finish();
  ASSERT_EQ(summary.trajectory.size(), truth.size());
  const WorstError worst = worst_error(summary.trajectory, truth);
  EXPECT_LT(worst.position, 0.008);
  EXPECT_LT(worst.turn, 0.008);
}

}  // namespace
}  // namespace vinebench
