// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/mapping/local_mapper.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::distance;
using test::SyntheticAisle;

Pose ahead(double x) {
  return {Eigen::Quaterniond::Identity(), {x, 0, 0}};
}

/// Frames have features but no images: nothing is placed on patches.
LocalMapperSettings without_patches() {
  LocalMapperSettings settings;
  settings.refinement = false;
  return settings;
}

class LocalMapperTest : public testing::Test {
 protected:
  /// What tracking gives of a frame: all features tied whose landmark is known.
  TrackedFrame tracked(const Pose& pose) const {
    TrackedFrame frame;
    frame.frame = aisle_.frame(static_cast<std::int64_t>(map_.keyframes().size()), pose);
    frame.tracked = true;
    frame.motion.T_map_body = pose;
    frame.associations = no_associations(*frame.frame);
    return frame;
  }
  /// The same with all features tied whose landmark a keyframe has.
  TrackedFrame tracked_with(const Pose& pose, int keyframe) const {
    std::map<int, int> landmark_of;
    const Keyframe& known = map_.keyframe(keyframe);
    for (std::size_t v = 0; v < known.landmarks.size(); ++v) {
      for (std::size_t f = 0; f < known.landmarks[v].size(); ++f) {
        if (known.landmarks[v][f] < 0) continue;
        landmark_of[aisle_.point_of(known.frame->views[v].features.descriptors[f])] =
            known.landmarks[v][f];
      }
    }
    TrackedFrame frame = tracked(pose);
    for (std::size_t v = 0; v < frame.associations.size(); ++v) {
      for (std::size_t f = 0; f < frame.associations[v].size(); ++f) {
        const auto found =
            landmark_of.find(aisle_.point_of(frame.frame->views[v].features.descriptors[f]));
        if (found != landmark_of.end()) frame.associations[v][f] = found->second;
      }
    }
    return frame;
  }
  std::size_t alive() const { return map_.count_landmarks(1); }
  static std::size_t features(const FrameFeatures& frame) {
    return frame.views[0].features.size() + frame.views[1].features.size();
  }
  void expect_on_the_walls() const {
    for (const Landmark& landmark : map_.landmarks()) {
      if (landmark.removed) continue;
      // Depths are floats: 4.8 m good to 5e-7 m; pixels to 3e-5 px, at 4.8 m 5e-7 m aside.
      const double error =
          (landmark.position - aisle_.point(aisle_.point_of(landmark.descriptor))).norm();
      EXPECT_LT(error, 5e-5) << landmark.id;
    }
  }

  SyntheticAisle aisle_{0, 1, 400};
  EstimatorRig rig_{aisle_.rig, OrbConfig{}};
  LocalMapperSettings settings_ = without_patches();
  Map map_{OrbConfig{}.scale};
};

TEST_F(LocalMapperTest, FeaturesWithADepthBecomeLandmarks) {
  const LocalMapper mapper(settings_);
  TrackedFrame frame = tracked(ahead(0.3));
  frame.frame->views[0].stereo[5] = {};
  // Too far away to be measured, yet found in the right image.
  frame.frame->views[0].stereo[6].depth = -1;
  EXPECT_EQ(mapper.insert(frame, rig_, map_), 0);
  EXPECT_EQ(alive(), features(*frame.frame) - 1);
  EXPECT_EQ(map_.keyframe(0).landmarks[0][5], -1);
  expect_on_the_walls();
}

TEST_F(LocalMapperTest, TrackedLandmarksAreTiedNotMadeAgain) {
  const LocalMapper mapper(settings_);
  mapper.insert(tracked(ahead(0)), rig_, map_);
  const std::size_t before = alive();
  const TrackedFrame next = tracked_with(ahead(0.2), 0);
  std::size_t tied = 0;
  for (const auto& view : next.associations) {
    tied += view.size() - static_cast<std::size_t>(std::ranges::count(view, -1));
  }
  ASSERT_GT(tied, 50u);
  mapper.insert(next, rig_, map_);
  EXPECT_EQ(alive(), before + features(*next.frame) - tied);
  EXPECT_EQ(map_.count_landmarks(2), tied);
  EXPECT_EQ(map_.covisible(0, 5), (std::vector<int>{1}));
}

TEST_F(LocalMapperTest, FollowedFeaturesMakeNoLandmarks) {
  TrackedFrame frame = tracked(ahead(0));
  frame.frame->views[0].followed = 10;  // the last ten
  LocalMapper(settings_).insert(frame, rig_, map_);
  EXPECT_EQ(alive(), features(*frame.frame) - 10);
}

TEST_F(LocalMapperTest, LandmarksThatTooFewKeyframesSawAreDropped) {
  settings_.mapping.trial_keyframes = 2;
  settings_.mapping.min_observations = 3;
  settings_.mapping.neighbours = 0;  // nothing is added or fused
  const LocalMapper mapper(settings_);
  mapper.insert(tracked(ahead(0)), rig_, map_);
  mapper.insert(tracked_with(ahead(0.15), 0), rig_, map_);
  mapper.extend(1, rig_, map_);
  std::size_t of_the_first = 0;
  for (const Landmark& landmark : map_.landmarks()) of_the_first += landmark.first_keyframe == 0;
  EXPECT_EQ(alive(), map_.landmarks().size());  // keyframe 0 is on trial yet
  mapper.insert(tracked_with(ahead(0.3), 1), rig_, map_);
  mapper.extend(2, rig_, map_);
  std::size_t dropped = 0;
  for (const Landmark& landmark : map_.landmarks()) {
    if (landmark.first_keyframe == 0) {
      EXPECT_EQ(landmark.removed, count_keyframes(landmark) < 3);
      dropped += landmark.removed;
    } else {
      EXPECT_FALSE(landmark.removed);
    }
  }
  EXPECT_GT(dropped, 0u);
  EXPECT_LT(dropped, of_the_first);
}

TEST_F(LocalMapperTest, FeaturesWithoutDepthAreTriangulatedBetweenKeyframes) {
  const LocalMapper mapper(settings_);
  // Every third feature of the front pair has no depth, in both keyframes.
  const auto without_depths = [&](TrackedFrame frame) {
    StereoView& view = frame.frame->views[0];
    for (std::size_t f = 0; f < view.features.size(); ++f) {
      const int point = aisle_.point_of(view.features.descriptors[f]);
      if (point % 3 != 0) continue;
      view.stereo[f] = {};
      frame.associations[0][f] = -1;
    }
    return frame;
  };
  mapper.insert(without_depths(tracked(ahead(0))), rig_, map_);
  mapper.insert(without_depths(tracked_with(ahead(0.3), 0)), rig_, map_);
  const std::size_t before = map_.landmarks().size();
  mapper.extend(1, rig_, map_);
  ASSERT_GT(map_.landmarks().size(), before + 10);
  for (std::size_t i = before; i < map_.landmarks().size(); ++i) {
    const Landmark& landmark = map_.landmarks()[i];
    EXPECT_EQ(aisle_.point_of(landmark.descriptor) % 3, 0);
    EXPECT_EQ(count_keyframes(landmark), 2);
    // Rays of at least a degree between them: 3e-5 px are 1e-7 rad, at 4.8 m 3e-5 m.
    EXPECT_LT((landmark.position - aisle_.point(aisle_.point_of(landmark.descriptor))).norm(),
              1e-3);
  }
}

TEST_F(LocalMapperTest, OneThingMappedTwiceIsFused) {
  const LocalMapper mapper(settings_);
  mapper.insert(tracked(ahead(0)), rig_, map_);
  // Half of what is known was not recognised, and is mapped again.
  TrackedFrame next = tracked_with(ahead(0.15), 0);
  std::size_t again = 0;
  for (std::vector<int>& view : next.associations) {
    for (std::size_t f = 0; f < view.size(); f += 2) {
      again += view[f] >= 0;
      view[f] = -1;
    }
  }
  ASSERT_GT(again, 30u);
  mapper.insert(next, rig_, map_);
  const std::size_t before = alive();
  mapper.extend(1, rig_, map_);
  EXPECT_EQ(alive(), before - again);
  expect_on_the_walls();
}

TEST_F(LocalMapperTest, TheLocalAdjustmentMovesTheKeyframeIntoPlace) {
  settings_.mapping.iterations = 30;
  const LocalMapper mapper(settings_);
  mapper.insert(tracked(ahead(0)), rig_, map_);
  mapper.insert(tracked_with(ahead(0.15), 0), rig_, map_);
  mapper.insert(tracked_with(ahead(0.3), 1), rig_, map_);
  Pose& pose = map_.keyframe(2).T_map_body;
  pose = pose * Pose{exp_so3({0.002, 0, 0.003}), {0.005, -0.004, 0.002}};
  const auto job = mapper.local_adjustment(2, map_, rig_);
  job->solve();
  EXPECT_GT(distance(pose, ahead(0.3)), 0.005);  // nothing has joined the map yet
  job->apply(map_);
  EXPECT_LT(distance(pose, ahead(0.3)), 1e-4);
}

TEST_F(LocalMapperTest, TheAdjustmentsOptionsAreTheSettings) {
  settings_.mapping.iterations = 17;
  settings_.tag_corner_sigma = 0.7;
  const AdjustmentOptions options = LocalMapper(settings_).adjustment_options();
  EXPECT_EQ(options.iterations, 17);
  EXPECT_EQ(options.tag_corner_sigma, 0.7);
  EXPECT_FALSE(options.global);
}

}  // namespace
}  // namespace vinebench::slam
