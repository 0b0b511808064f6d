// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/keyframe_selector.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

constexpr int kFeatures = 1000;

/// A map of one keyframe with 400 landmarks, and frames that track some of them.
class KeyframeSelectorTest : public testing::Test {
 protected:
  KeyframeSelectorTest() {
    map_.add_keyframe(frame(10), Pose{}, {});
    for (int f = 0; f < 400; ++f) map_.add_landmark({1, 0, 0}, {0, 0, f});
  }

  static std::shared_ptr<FrameFeatures> frame(std::int64_t index) {
    auto features = std::make_shared<FrameFeatures>();
    features->index = index;
    features->views.resize(1);
    features->views[0].features.keypoints.resize(kFeatures);
    features->views[0].features.descriptors.resize(kFeatures);
    features->views[0].stereo.assign(kFeatures, StereoMatch{100, 1.0F});
    return features;
  }

  /// `inliers` tracked; every other feature has a depth and no landmark.
  static TrackedFrame tracked(std::int64_t index, int inliers, const Pose& pose = {}) {
    TrackedFrame tracked;
    tracked.frame = frame(index);
    tracked.associations = no_associations(*tracked.frame);
    for (int f = 0; f < inliers; ++f) tracked.associations[0][static_cast<std::size_t>(f)] = f;
    tracked.motion.inliers = inliers;
    tracked.motion.T_map_body = pose;
    return tracked;
  }
  bool wants(std::int64_t index, int inliers, const Pose& pose = {}) const {
    return wants_keyframe(tracked(index, inliers, pose), map_, config_);
  }
  static Pose at_x(double x) { return {Eigen::Quaterniond::Identity(), {x, 0, 0}}; }
  static Pose turned_by(double yaw) { return {exp_so3({0, 0, yaw}), Eigen::Vector3d::Zero()}; }

  Map map_{1.2};
  KeyframeConfig config_ = [] {
    KeyframeConfig config;
    config.min_gap = 2;
    return config;
  }();
};

TEST_F(KeyframeSelectorTest, AFrameLikeTheLastKeyframeIsNone) {
  EXPECT_FALSE(wants(20, 390));
  EXPECT_FALSE(wants(20, 390, Pose{exp_so3({0, 0, 0.2}), {0.24, 0, 0}}));  // 11.5 degrees
}

TEST_F(KeyframeSelectorTest, FewLandmarksAskForOne) {
  config_.reduction = 0;
  EXPECT_FALSE(wants(20, 200));
  EXPECT_TRUE(wants(20, 199));
}

TEST_F(KeyframeSelectorTest, SoDoesFallingBelowAShareOfTheLastOnes) {
  config_.min_inliers = 0;
  EXPECT_FALSE(wants(20, 280));  // 0.7 of 400
  EXPECT_TRUE(wants(20, 279));
}

TEST_F(KeyframeSelectorTest, OnlyWellFoundedLandmarksOfTheLastKeyframeCount) {
  config_.min_inliers = 0;
  // Two more keyframes; 100 of the landmarks are seen by all three.
  for (int k = 1; k <= 2; ++k) {
    map_.add_keyframe(frame(10 + k), Pose{}, {});
    for (int f = 0; f < 100; ++f) map_.add_observation(f, {k, 0, f});
    for (int f = 100; f < 400; ++f) map_.add_landmark({1, 0, 0}, {k, 0, f});
  }
  EXPECT_FALSE(wants(20, 70));
  EXPECT_TRUE(wants(20, 69));
}

TEST_F(KeyframeSelectorTest, SoDoMovingAndTurning) {
  EXPECT_TRUE(wants(20, 390, Pose{Eigen::Quaterniond::Identity(), {0, 0.26, 0}}));
  EXPECT_TRUE(
      wants(20, 390, Pose{exp_so3({0, 0, -0.22}), Eigen::Vector3d::Zero()}));  // 12.6 degrees
}

TEST_F(KeyframeSelectorTest, ButNotTooSoonAfterTheLast) {
  EXPECT_FALSE(wants(11, 50, Pose{Eigen::Quaterniond::Identity(), {1, 0, 0}}));
  EXPECT_TRUE(wants(12, 50, Pose{Eigen::Quaterniond::Identity(), {1, 0, 0}}));
}

TEST_F(KeyframeSelectorTest, IsOverdueAfterTwiceTheWayOrTheTurn) {
  EXPECT_FALSE(is_overdue(tracked(20, 390, at_x(0.49)), map_, config_));  // 0.25 m apart
  EXPECT_TRUE(is_overdue(tracked(20, 390, at_x(0.51)), map_, config_));
  // 12 degrees apart: 0.419 rad.
  EXPECT_FALSE(is_overdue(tracked(20, 390, turned_by(0.41)), map_, config_));
  EXPECT_TRUE(is_overdue(tracked(20, 390, turned_by(0.43)), map_, config_));
}

TEST_F(KeyframeSelectorTest, ALoadedMapCoversWhereItsKeyframesAreNear) {
  EXPECT_FALSE(is_covered(tracked(20, 390), map_, config_));  // the keyframe is of this run
  map_ = Map{1.2};
  map_.add_keyframe(frame(-1), Pose{}, {});
  EXPECT_TRUE(is_covered(tracked(20, 200, at_x(0.24)), map_, config_));
  EXPECT_FALSE(is_covered(tracked(20, 199, at_x(0.24)), map_, config_));  // tracks too little
  EXPECT_FALSE(is_covered(tracked(20, 390, at_x(0.26)), map_, config_));
  EXPECT_FALSE(is_covered(tracked(20, 390, turned_by(0.22)), map_, config_));
}

TEST_F(KeyframeSelectorTest, ATagSaysMoreFromFiveCentimetresOn) {
  TrackedFrame near = tracked(20, 390, at_x(0.049));
  TrackedFrame far = tracked(20, 390, at_x(0.051));
  EXPECT_FALSE(sees_tag_from_elsewhere(far, map_));  // no tag
  for (TrackedFrame* seen : {&near, &far}) seen->frame->tags.resize(1);
  EXPECT_FALSE(sees_tag_from_elsewhere(near, map_));
  EXPECT_TRUE(sees_tag_from_elsewhere(far, map_));
}

TEST_F(KeyframeSelectorTest, WithNothingNewToSeeAWeakFrameAddsNothing) {
  TrackedFrame tracked;
  auto features = std::make_shared<FrameFeatures>(*frame(20));
  // 100 tracked; of the others ten have a depth, a tenth of the tracked ones.
  for (std::size_t f = 110; f < kFeatures; ++f) features->views[0].stereo[f] = StereoMatch{};
  tracked.frame = features;
  tracked.associations = no_associations(*features);
  for (int f = 0; f < 100; ++f) tracked.associations[0][static_cast<std::size_t>(f)] = f;
  tracked.motion.inliers = 100;
  EXPECT_FALSE(wants_keyframe(tracked, map_, config_));
  features->views[0].stereo[110] = StereoMatch{100, 1.0F};
  EXPECT_TRUE(wants_keyframe(tracked, map_, config_));
}

}  // namespace
}  // namespace vinebench::slam
