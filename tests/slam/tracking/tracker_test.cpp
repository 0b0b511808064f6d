// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/tracker.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/util/random.h"
#include "tests/support/aisle_drive.h"
#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::angle;
using test::distance;
using test::SyntheticAisle;

Pose ahead(double x, double yaw = 0) {
  return {exp_so3({0, 0, yaw}), {x, 0, 0}};
}

std::vector<Pose> along_the_aisle() {
  std::vector<Pose> poses;
  for (int i = 0; i < 8; ++i) poses.push_back(ahead(0.25 * i));
  return poses;
}

class TrackerTest : public testing::Test {
 protected:
  TrackedFrame track(Tracker& tracker, std::int64_t index, const Pose& pose,
                     const std::vector<std::size_t>& blind = {},
                     const std::optional<Pose>& wheels = std::nullopt) {
    auto frame = aisle_.frame(index, pose, blind);
    if (wheels) frame->wheels = WheelStep{*wheels, 1.0 / 15};
    return tracker.track(frame, made_.map, made_.rig);
  }
  /// A frame of which only every n-th feature looks like a landmark of the map.
  std::shared_ptr<FrameFeatures> every(std::size_t n, std::int64_t index, const Pose& pose) {
    auto frame = aisle_.frame(index, pose);
    const RandomStream random(5, "foreign features");
    std::uint64_t drawn = 0;
    for (StereoView& view : frame->views) {
      for (std::size_t f = 0; f < view.features.size(); ++f) {
        if (f % n == 0) continue;
        for (std::uint64_t& word : view.features.descriptors[f]) word = random.bits(drawn++);
      }
    }
    return frame;
  }
  TrackedFrame track_every(std::size_t n, Tracker& tracker, std::int64_t index, const Pose& pose) {
    return tracker.track(every(n, index, pose), made_.map, made_.rig);
  }
  /// A tracker that has followed a few frames of 2 cm each.
  Tracker moving(int frames) {
    Tracker tracker(settings_);
    tracker.start(ahead(0), stamp_of_frame(0, 15));
    for (int i = 1; i <= frames; ++i) EXPECT_TRUE(track(tracker, i, ahead(0.02 * i)).tracked) << i;
    return tracker;
  }
  static const std::vector<std::size_t>& all_blind() {
    static const std::vector<std::size_t> kAll{0, 1};
    return kAll;
  }

  SyntheticAisle aisle_{0, 1, 1200};
  AisleMap made_{aisle_, along_the_aisle()};
  TrackerSettings settings_;
};

// Pixels are floats, 3e-5 px at 500: some hundred put a pose right to 1e-6 m.
TEST_F(TrackerTest, FollowsTheBodyAndTiesItsFeatures) {
  Tracker tracker(settings_);
  tracker.start(ahead(0), stamp_of_frame(0, 15));
  for (int i = 1; i <= 10; ++i) {
    const Pose truth = ahead(0.02 * i, 0.01 * i);
    const TrackedFrame tracked = track(tracker, i, truth);
    ASSERT_TRUE(tracked.tracked) << i;
    EXPECT_LT(distance(tracked.motion.T_map_body, truth), 2e-6) << i;
    EXPECT_LT(angle(tracker.T_map_body(), truth), 2e-6) << i;
    const Associations right = made_.associate(*tracked.frame);
    int tied = 0;
    for (std::size_t v = 0; v < right.size(); ++v) {
      for (std::size_t f = 0; f < right[v].size(); ++f) {
        if (tracked.associations[v][f] < 0) continue;
        EXPECT_EQ(tracked.associations[v][f], right[v][f]);
        ++tied;
      }
    }
    EXPECT_EQ(tied, tracked.motion.inliers);
    EXPECT_GT(tied, 100);
  }
}

// Way s = t^2 / 2 m and turn of as many rad, at 15 frames a second: after n frames both speeds are
// n / 15, and that of the last step was (n - 1/2) / 15. The way's end is tangent to the body, whose
// x axis the ways of the two steps leave by their turn: 3 mm/s of 0.27 m/s.
TEST_F(TrackerTest, AFramesVelocityIsThatOfItsInstant) {
  Tracker tracker(settings_);
  tracker.start(ahead(0), stamp_of_frame(0, 15));
  TrackedFrame tracked;
  for (int i = 1; i <= 4; ++i) {
    const double s = 0.5 * i * i / 225.0;
    tracked = track(tracker, i, ahead(s, s));
    ASSERT_TRUE(tracked.tracked) << i;
  }
  EXPECT_NEAR(tracked.frame->velocity[0], 4 / 15.0, 0.003);
  EXPECT_NEAR(tracked.frame->velocity[5], 4 / 15.0, 1e-3);
}

TEST_F(TrackerTest, FindsItselfWhereThePredictionIsFarOff) {
  Tracker tracker = moving(3);
  // A jolt of 0.4 rad: 100 px, beyond the widest search of 40 px.
  const Pose jolted = ahead(0.1, 0.4);
  const TrackedFrame tracked = track(tracker, 4, jolted);
  ASSERT_TRUE(tracked.tracked);
  EXPECT_LT(distance(tracked.motion.T_map_body, jolted), 2e-6);
}

TEST_F(TrackerTest, APoseByAppearanceMustBeWithinReach) {
  settings_.tracking.max_speed = 3;  // m/s: 0.2 m a frame
  Tracker tracker = moving(3);
  // The same jump is beyond reach for one of 3 m/s, and within for one of 35 m/s.
  EXPECT_FALSE(track(tracker, 4, ahead(0.8, 0.4)).tracked);
  settings_.tracking.max_speed = 35;
  Tracker fast = moving(3);
  EXPECT_TRUE(track(fast, 4, ahead(0.8, 0.4)).tracked);
}

TEST_F(TrackerTest, WithoutSightItsLastVelocityIsKept) {
  Tracker tracker = moving(5);
  const TrackedFrame tracked = track(tracker, 6, ahead(0.12), all_blind());
  EXPECT_FALSE(tracked.tracked);
  EXPECT_TRUE(tracker.dead_reckoning().active());
  EXPECT_LT(distance(tracker.T_map_body(), ahead(0.12)), 1e-5);
  track(tracker, 7, ahead(0.14), all_blind());
  EXPECT_EQ(tracker.dead_reckoning().frames(), 2);
  EXPECT_LT(distance(tracker.T_map_body(), ahead(0.14)), 1e-5);
  EXPECT_TRUE(track(tracker, 8, ahead(0.16)).tracked);
  EXPECT_FALSE(tracker.dead_reckoning().active());
}

TEST_F(TrackerTest, WithoutSightItsWheelsAreBelievedBeforeItsVelocity) {
  Tracker tracker = moving(5);
  const Pose step = ahead(0.05, 0.1);
  track(tracker, 6, ahead(0.1), all_blind(), step);
  EXPECT_LT(distance(tracker.T_map_body(), ahead(0.1) * step), 1e-5);
  // The next prediction is by the wheels too, so that sight is found there.
  const Pose next = ahead(0.1) * step * step;
  EXPECT_TRUE(track(tracker, 7, next, {}, step).tracked);
  EXPECT_LT(distance(tracker.T_map_body(), next), 1e-5);
}

TEST_F(TrackerTest, SightThatComesBackMustAgreeWithDeadReckoning) {
  Tracker tracker = moving(5);
  const Pose step = ahead(0.02);
  track(tracker, 6, ahead(0.12), all_blind(), step);
  // 2 cm by the wheels with 5 % of slip, four deviations of it and 5 cm of the pose's own: 5.4 cm.
  EXPECT_FALSE(track(tracker, 7, ahead(0.14 + 0.15), {}, step).tracked);
  EXPECT_TRUE(track(tracker, 8, ahead(0.16 + 0.02), {}, step).tracked);
}

/// At 0.3 m/s for two seconds, then without sight to a stop, for a second.
double braking(double t) {
  const double since = std::clamp(t - 2, 0.0, 1.0);
  return 0.3 * (std::min(t, 2.0) + since - since * since / 2);
}

TEST_F(TrackerTest, WithoutSightItsInertialUnitKnowsThatItBrakes) {
  settings_.inertial = InertialNoise{};
  Tracker tracker(settings_);
  tracker.start(ahead(0), 0);
  for (int i = 1; i <= 48; ++i) {
    const Stamp before = stamp_of_frame(i - 1, 15);
    const Stamp stamp = stamp_of_frame(i, 15);
    const bool blind = i > 30;
    auto frame = aisle_.frame(i, ahead(braking(to_seconds(stamp))),
                              blind ? all_blind() : std::vector<std::size_t>{});
    for (int k = 1; k <= 10; ++k) {
      const Stamp t = before + (stamp - before) * k / 10;
      const bool brakes = to_seconds(t) > 2 && to_seconds(t) <= 3;
      frame->imu.push_back({t, Eigen::Vector3d::Zero(), {brakes ? -0.3 : 0, 0, 9.80665}});
    }
    EXPECT_EQ(tracker.track(frame, made_.map, made_.rig).tracked, !blind) << i;
  }
  // With the last velocity it would be 0.21 m too far. Biases are known to 5 mm/s^2 after two
  // seconds of sight: half of that in 1.2 s, squared.
  EXPECT_LT(distance(tracker.T_map_body(), ahead(braking(3.2))), 0.01);
  EXPECT_LT(tracker.dead_reckoning().sigma_position(), 0.05);
  EXPECT_GT(tracker.dead_reckoning().sigma_position(), 0.002);
}

// Twelve frames of 1/15 s with an unknown acceleration of 0.5 m/s^2: 0.16 m, and four times that
// reaches the next vine. There every twelfth feature may look like one here.
TEST_F(TrackerTest, AfterALongGapAFewFeaturesAreNotEnough) {
  Tracker tracker = moving(5);
  ASSERT_TRUE(track_every(12, tracker, 6, ahead(0.12)).tracked) << "without a gap they are";
  for (int i = 7; i < 19; ++i) track(tracker, i, ahead(0.02 * i), all_blind());
  const TrackedFrame few = track_every(12, tracker, 19, ahead(0.38));
  EXPECT_FALSE(few.tracked);
  EXPECT_GT(few.motion.inliers, settings_.tracking.min_inliers);
  EXPECT_TRUE(track_every(2, tracker, 20, ahead(0.4)).tracked);
  EXPECT_LT(distance(tracker.T_map_body(), ahead(0.4)), 2e-6);
  EXPECT_TRUE(track_every(12, tracker, 21, ahead(0.42)).tracked);
}

// Six blind frames of 1/15 s with an unknown acceleration of 0.5 m/s^2 leave a standard deviation
// of 0.04 m. The body is expected at 0.24 m; 2.5 of these and the pose's own 0.05 m are 0.15 m:
// what is farther must be borne out, though 4 of them would let it pass.
TEST_F(TrackerTest, AfterAGapAnUnlikelyPoseMustBeBorneOutByWhatIsThere) {
  const auto after_gap = [&] {
    Tracker tracker = moving(5);
    for (int i = 6; i < 12; ++i) track(tracker, i, ahead(0.02 * i), all_blind());
    return tracker;
  };
  Tracker likely = after_gap();
  EXPECT_TRUE(track_every(12, likely, 12, ahead(0.24 + 0.13)).tracked);
  Tracker tracker = after_gap();
  const TrackedFrame few = track_every(12, tracker, 12, ahead(0.24 + 0.18));
  EXPECT_FALSE(few.tracked);
  EXPECT_GE(few.motion.inliers, settings_.tracking.min_inliers);
  Tracker other = after_gap();
  EXPECT_TRUE(track_every(2, other, 12, ahead(0.24 + 0.18)).tracked);
}

// In between two frames the body does not move by 0.8 m: that place is believed by its looks, if
// they are those of most that is there.
TEST_F(TrackerTest, AJumpByLooksMustBeBorneOutByWhatIsThere) {
  Tracker tracker = moving(3);
  const TrackedFrame few = track_every(12, tracker, 4, ahead(0.8, 0.4));
  EXPECT_FALSE(few.tracked);
  std::size_t features = 0;
  for (const StereoView& view : few.frame->views) features += view.features.size();
  EXPECT_GE(features / 12, 2u * static_cast<std::size_t>(settings_.tracking.min_inliers));
  Tracker other = moving(3);
  EXPECT_TRUE(track_every(2, other, 4, ahead(0.8, 0.4)).tracked);
}

// Of what is 0.72 m farther 72 features are seen, a twelfth of it and too little for a jump; those
// that are seen where they are expected, an eleventh, are enough for that.
TEST_F(TrackerTest, WhatResemblesAnotherPlaceSaysNothingAgainstThePredictedOne) {
  Tracker tracker = moving(3);
  const auto frame =
      test::both(*every(11, 4, ahead(0.08)), *every(12, 4, ahead(0.8, 0.4)), aisle_.rig);
  const TrackedFrame tracked = tracker.track(frame, made_.map, made_.rig);
  EXPECT_TRUE(tracked.tracked);
  EXPECT_LT(distance(tracked.motion.T_map_body, ahead(0.08)), 1e-3);
}

// Expected at 0.08 m. Within a fifteenth of a second 10 m/s^2 make 0.04 m, and a pose has 0.05 m of
// noise: what is farther must be borne out as well, by whichever way it was found.
TEST_F(TrackerTest, AJoltThatNoRobotMakesMustBeBorneOutByWhatIsThere) {
  Tracker gentle = moving(3);
  EXPECT_TRUE(track_every(12, gentle, 4, ahead(0.08 + 0.08)).tracked);
  Tracker tracker = moving(3);
  const TrackedFrame few = track_every(12, tracker, 4, ahead(0.08 + 0.11));
  EXPECT_FALSE(few.tracked);
  EXPECT_GE(few.motion.inliers, settings_.tracking.min_inliers);
  Tracker other = moving(3);
  EXPECT_TRUE(track_every(2, other, 4, ahead(0.08 + 0.11)).tracked);
  // After a start nobody knows how fast it moves.
  Tracker started(settings_);
  started.start(ahead(0), stamp_of_frame(0, 15));
  EXPECT_TRUE(track_every(12, started, 1, ahead(0.3)).tracked);
}

TEST_F(TrackerTest, AGuessedPoseMustBeBorneOutByWhatIsThere) {
  Tracker tracker(settings_);
  tracker.start(ahead(0.1), stamp_of_frame(0, 15), true);
  EXPECT_FALSE(track_every(12, tracker, 1, ahead(0.1)).tracked);
  tracker.start(ahead(0.1), stamp_of_frame(1, 15), true);
  EXPECT_TRUE(track_every(2, tracker, 2, ahead(0.1)).tracked);
  tracker.start(ahead(0.1), stamp_of_frame(2, 15));
  EXPECT_TRUE(track_every(12, tracker, 3, ahead(0.1)).tracked) << "what a tag says is no guess";
}

TEST_F(TrackerTest, ACorrectionMovesThePrediction) {
  Tracker tracker = moving(5);
  // Something knows the body to be half a metre ahead.
  tracker.correct(ahead(0.6));
  EXPECT_EQ(tracker.T_map_body().translation.x(), 0.6);
  track(tracker, 6, ahead(0.62), all_blind());
  EXPECT_LT(distance(tracker.T_map_body(), ahead(0.62)), 1e-5);
}

TEST_F(TrackerTest, StartsStandingStill) {
  Tracker tracker = moving(5);
  tracker.start(ahead(1), stamp_of_frame(6, 15));
  track(tracker, 7, ahead(1), all_blind());
  EXPECT_EQ(distance(tracker.T_map_body(), ahead(1)), 0);
}

TEST_F(TrackerTest, TooFewInliersAreLost) {
  settings_.tracking.min_inliers = 5000;
  Tracker tracker(settings_);
  tracker.start(ahead(0), stamp_of_frame(0, 15));
  EXPECT_FALSE(track(tracker, 1, ahead(0.02)).tracked);
}

TEST(LocalLandmarksTest, AreThoseOfKeyframesThatShareMostOrAreNear) {
  const SyntheticAisle aisle(0, 1, 800);
  // Two places 4 m apart, and one near the first that looks the other way.
  AisleMap made(aisle, {ahead(0), ahead(4), ahead(0.1, 3.0)});
  const auto ids_of = [&](const std::vector<int>& keyframes) {
    std::vector<int> ids;
    for (const int k : keyframes) {
      const std::vector<int> own = landmark_ids(made.map.keyframe(k).landmarks);
      ids.insert(ids.end(), own.begin(), own.end());
    }
    std::ranges::sort(ids);
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  };
  // Nothing was seen: only keyframes within 1 m that look the same way.
  EXPECT_EQ(local_landmarks(made.map, {}, ahead(0.5), 20), ids_of({0}));
  EXPECT_TRUE(local_landmarks(made.map, {}, ahead(2), 20).empty());
  // What the far keyframe alone saw brings it in.
  std::vector<int> seen;
  for (const int id : ids_of({1})) {
    if (made.map.landmark(id).observations.size() == 1) seen.push_back(id);
  }
  ASSERT_GT(seen.size(), 3u);
  EXPECT_EQ(local_landmarks(made.map, seen, ahead(2), 20), ids_of({1}));
  EXPECT_EQ(local_landmarks(made.map, seen, ahead(0.5), 20), ids_of({0, 1}));
  // The one with most votes where there is room for one.
  EXPECT_EQ(local_landmarks(made.map, seen, ahead(0.5), 1), ids_of({1}));
  // Turned about there is one that looks the same way, and beside the far one none.
  EXPECT_EQ(local_landmarks(made.map, {}, ahead(0.5, 3.0), 20), ids_of({2}));
  EXPECT_EQ(local_landmarks(made.map, {}, ahead(4, 3.0), 20), ids_of({1}));
}

}  // namespace
}  // namespace vinebench::slam
