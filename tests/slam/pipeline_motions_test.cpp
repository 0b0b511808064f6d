// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

/// The pipeline with difficult motions: a rotation on the spot and a minute at rest; and with rigs
/// of one, two and three pairs.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slam/pipeline.h"
#include "tests/support/aisle_map.h"
#include "tests/support/rigs.h"

namespace vinebench::slam {
namespace {

using test::angle;
using test::distance;
using test::rig_of_pairs;
using test::SyntheticAisle;

SyntheticAisle make_aisle(double noise, std::uint64_t seed, int landmarks, std::size_t pairs = 2) {
  SyntheticAisle aisle(noise, seed, landmarks);
  aisle.rig = rig_of_pairs(aisle.rig, pairs);
  return aisle;
}

/// Greatest distance, m, and angle, rad, to the truth; both relative to their first pose.
struct WorstError {
  double position = 0;
  double turn = 0;
};

WorstError worst_errors(const Trajectory& estimate, const std::vector<Pose>& truth) {
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
WorstError drive(const SyntheticAisle& aisle, const std::vector<Pose>& truth) {
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Estimate estimate = pipeline.process(aisle.frame(static_cast<std::int64_t>(i), truth[i]));
    EXPECT_EQ(estimate.status, TrackingStatus::kTracking) << i;
  }
  const SlamSummary summary = pipeline.finish();
  EXPECT_EQ(summary.trajectory.size(), truth.size());
  return worst_errors(summary.trajectory, truth);
}

/// Along the aisle at `speed`, 15 frames a second, swaying in heading.
Pose driving_at(std::int64_t frame, double speed) {
  const double x = speed / 15 * static_cast<double>(frame);
  return {exp_so3({0, 0, 0.1 * std::sin(2.0 * x)}), {x, 0.05 * std::sin(x), 0}};
}

class RigOfPairsTest : public testing::TestWithParam<std::size_t> {};

TEST_P(RigOfPairsTest, RecoversTheWayExactlyWithoutNoise) {
  const SyntheticAisle aisle = make_aisle(0, 1, 3000, GetParam());
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 45; ++i) truth.push_back(driving_at(i, 0.3));
  const WorstError worst = drive(aisle, truth);
  // Pixels are held as floats, 3e-5 px at 500: about 1e-7 m a keyframe at half a metre.
  EXPECT_LT(worst.position, 2e-6);
  EXPECT_LT(worst.turn, 2e-6);
}

TEST_P(RigOfPairsTest, DriftsLittleWithNoise) {
  const SyntheticAisle aisle = make_aisle(0.5, 2, 3000, GetParam());
  std::vector<Pose> truth;
  for (std::int64_t i = 0; i < 90; ++i) truth.push_back(driving_at(i, 0.3));
  const WorstError worst = drive(aisle, truth);
  // Half a pixel of a coarse level, 1.8 px, at half a metre is 3.4 mm for one feature and 0.2 mm
  // for 300; over some ten keyframes and the lever of their headings ten times that, and three
  // times.
  EXPECT_LT(worst.position, 0.006);
  EXPECT_LT(worst.turn, 0.006);
}

INSTANTIATE_TEST_SUITE_P(Pairs, RigOfPairsTest, testing::Values(1, 2, 3));

std::vector<Pose> turning(int frames) {
  std::vector<Pose> poses;
  for (int i = 0; i < frames; ++i) {
    poses.push_back({exp_so3({0, 0, 2.0 * i * std::numbers::pi / 180}), {0.1, 0.02, 0}});
  }
  return poses;
}

TEST(PipelineMotionsTest, TurnsOnTheSpot) {
  // 30 degrees a second: there is no parallax except that of the stereo pairs.
  const WorstError exact = drive(make_aisle(0, 3, 1000), turning(90));
  EXPECT_LT(exact.position, 1e-5);  // m; pixels are floats, as above, over twenty keyframes
  EXPECT_LT(exact.turn, 1e-5);      // rad
  // Slightly more than one full turn. Landmarks half a metre away are found on coarse levels, where
  // half a pixel is 1.8 px of the image: over some 200 of them and both ends 1.8 / 263 / sqrt(100)
  // = 0.7 mrad a keyframe, over 40 keyframes 4 mrad, and twice that; 1 mm of the cameras' lever of
  // 0.15 m and of the landmarks themselves goes with it.
  const WorstError noisy = drive(make_aisle(0.5, 3, 1000), turning(200));
  EXPECT_LT(noisy.position, 0.008);
  EXPECT_LT(noisy.turn, 0.009);
}

TEST(PipelineMotionsTest, DoesNotDriftInAMinuteOfRest) {
  const SyntheticAisle aisle = make_aisle(0.5, 4, 700);
  Pipeline pipeline(SlamConfig{}, aisle.rig, {});
  for (std::int64_t i = 0; i < 900; ++i) pipeline.process(aisle.frame(i, driving_at(10, 0.3)));
  const SlamSummary summary = pipeline.finish();
  ASSERT_EQ(summary.trajectory.size(), 900u);
  EXPECT_LE(summary.keyframes.size(), 2u);
  // The noise of a frame is not drift: the mean over a second must not drift.
  std::vector<Vector6d> seconds(60, Vector6d::Zero());
  for (std::size_t i = 0; i < 900; ++i) {
    const Pose& pose = summary.trajectory[i].pose;
    seconds[i / 15].head<3>() += pose.translation / 15;
    seconds[i / 15].tail<3>() += log_so3(pose.rotation) / 15;
  }
  for (std::size_t s = 1; s < 60; ++s) {
    EXPECT_LT((seconds[s] - seconds[0]).head<3>().norm(), 0.001) << s;  // m
    EXPECT_LT((seconds[s] - seconds[0]).tail<3>().norm(), 0.001) << s;  // rad
  }
}

}  // namespace
}  // namespace vinebench::slam
