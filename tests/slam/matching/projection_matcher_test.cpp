// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/projection_matcher.h"

#include <gtest/gtest.h>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::SyntheticAisle;

class ProjectionMatcherTest : public testing::Test {
 protected:
  ProjectionMatcherTest() : truth_(aisle_, {Pose{}}) {
    for (const Landmark& landmark : truth_.map.landmarks()) landmarks_.push_back(landmark.id);
  }

  int match(const FrameFeatures& frame, const Pose& prediction, Associations& found,
            const ProjectionSearch& search = {}) const {
    return match_by_projection(truth_.map, landmarks_, frame, prediction, truth_.rig, search,
                               found);
  }

  /// Number of correct matches in `found`, and whether any is wrong.
  int count_right(const FrameFeatures& frame, const Associations& found, int view) const {
    const Associations truth = truth_.associate(frame);
    int right = 0;
    const auto v = static_cast<std::size_t>(view);
    for (std::size_t f = 0; f < found[v].size(); ++f) {
      if (found[v][f] < 0) continue;
      EXPECT_EQ(found[v][f], truth[v][f]);
      ++right;
    }
    return right;
  }

  SyntheticAisle aisle_{0.5, 1, 2000};
  AisleMap truth_;
  std::vector<int> landmarks_;
};

TEST_F(ProjectionMatcherTest, FindsLandmarksInBothPairs) {
  const Pose pose{exp_so3({0, 0, 0.03}), {0.05, 0.01, 0}};
  const auto frame = aisle_.frame(1, pose);
  const Associations truth = truth_.associate(*frame);
  Associations found = no_associations(*frame);
  const int added = match(*frame, pose, found);
  int right = 0;
  for (int view = 0; view < 2; ++view) {
    const auto v = static_cast<std::size_t>(view);
    const auto known = static_cast<int>(
        std::count_if(truth[v].begin(), truth[v].end(), [](int id) { return id >= 0; }));
    ASSERT_GT(known, 100);
    const int in_view = count_right(*frame, found, view);
    EXPECT_GT(in_view, known * 9 / 10) << view;
    right += in_view;
  }
  EXPECT_EQ(added, right);
}

TEST_F(ProjectionMatcherTest, ALandmarkOfTheFrontPairIsFoundByTheBackPair) {
  // After turning round, the back pair sees what the front pair saw, with the same descriptors.
  const Pose turned{exp_so3({0, 0, 3.14159265}), {0.0, 0, 0}};
  const auto frame = aisle_.frame(1, turned);
  Associations found = no_associations(*frame);
  match(*frame, turned, found);
  int of_front = 0;
  for (const int id : found[1]) {
    of_front += id >= 0 && truth_.map.landmark(id).observations.front().view == 0;
  }
  EXPECT_GT(of_front, 100);
  count_right(*frame, found, 1);
}

TEST_F(ProjectionMatcherTest, LooksWithinItsRadiusOnly) {
  const Pose pose{Eigen::Quaterniond::Identity(), {0.05, 0, 0}};
  const auto frame = aisle_.frame(1, pose);
  // Rotated by 6 degrees, every projection is off by 28 px and more: 263 px * tan(6 degrees).
  const Pose off = pose * Pose{exp_so3({0, 0, 0.105}), Eigen::Vector3d::Zero()};
  ProjectionSearch near;
  near.radius = 5;  // at the top level of 3.6 px this is 18 px
  Associations found = no_associations(*frame);
  EXPECT_EQ(match(*frame, off, found, near), 0);
  ProjectionSearch wide;
  wide.radius = 60;
  EXPECT_GT(match(*frame, off, found, wide), 100);
}

TEST_F(ProjectionMatcherTest, LooksOnLevelsNearThePredictedOne) {
  const auto frame = aisle_.frame(0, Pose{});
  auto moved = std::make_shared<FrameFeatures>(*frame);
  for (StereoView& view : moved->views) {
    for (Keypoint& keypoint : view.features.keypoints) {
      keypoint.level = keypoint.level >= 4 ? keypoint.level - 3 : keypoint.level + 3;
    }
    view.grid = FeatureGrid(view.features.keypoints, 752, 480);
  }
  Associations found = no_associations(*frame);
  EXPECT_GT(match(*frame, Pose{}, found), 100);
  found = no_associations(*frame);
  EXPECT_EQ(match(*moved, Pose{}, found), 0);
}

TEST_F(ProjectionMatcherTest, LooksAtTheDescriptorAndTheNextBest) {
  auto frame = std::make_shared<FrameFeatures>(*aisle_.frame(0, Pose{}));
  const auto flip = [&](int bits) {
    auto changed = std::make_shared<FrameFeatures>(*frame);
    for (StereoView& view : changed->views) {
      for (Descriptor& d : view.features.descriptors) {
        for (int b = 0; b < bits; ++b) d[static_cast<std::size_t>(b) / 64] ^= 1ULL << (b % 64);
      }
    }
    return changed;
  };
  Associations found = no_associations(*frame);
  EXPECT_GT(match(*flip(64), Pose{}, found), 100);
  found = no_associations(*frame);
  EXPECT_EQ(match(*flip(65), Pose{}, found), 0);

  // Every feature is duplicated: the second best is as good, and no match is accepted.
  auto doubled = std::make_shared<FrameFeatures>(*frame);
  for (StereoView& view : doubled->views) {
    const StereoView once = view;
    for (std::size_t f = 0; f < once.features.size(); ++f) {
      view.features.keypoints.push_back(once.features.keypoints[f]);
      view.features.descriptors.push_back(once.features.descriptors[f]);
      view.stereo.push_back(once.stereo[f]);
    }
    view.grid = FeatureGrid(view.features.keypoints, 752, 480);
  }
  found = no_associations(*doubled);
  EXPECT_EQ(match(*doubled, Pose{}, found), 0);
}

TEST_F(ProjectionMatcherTest, ADepthThatDoesNotFitIsNotTaken) {
  auto frame = std::make_shared<FrameFeatures>(*aisle_.frame(0, Pose{}));
  for (StereoView& view : frame->views) {
    for (StereoMatch& match : view.stereo) match.x_right -= 60;  // px; radius is 36 at most
  }
  Associations found = no_associations(*frame);
  EXPECT_EQ(match(*frame, Pose{}, found), 0);
}

TEST_F(ProjectionMatcherTest, OfTwoLandmarksThatAskForOneFeatureTheMoreAlikeHasIt) {
  const auto frame = aisle_.frame(0, Pose{});
  Map& map = truth_.map;
  // A duplicate of landmark 0 with a descriptor that differs by 20 bits.
  const Landmark original = map.landmark(0);
  const Observation seen = original.observations.front();
  Landmark copy = original;
  copy.id = static_cast<int>(map.landmarks().size());
  copy.descriptor[0] ^= 0xfffff;
  map.landmarks().push_back(copy);
  for (const std::vector<int>& order :
       {std::vector<int>{original.id, copy.id}, std::vector<int>{copy.id, original.id}}) {
    Associations found = no_associations(*frame);
    EXPECT_EQ(match_by_projection(map, order, *frame, Pose{}, truth_.rig, {}, found), 1);
    EXPECT_EQ(found[static_cast<std::size_t>(seen.view)][static_cast<std::size_t>(seen.feature)],
              original.id);
  }
}

TEST_F(ProjectionMatcherTest, WhatIsTiedStaysSoAndRemovedLandmarksAreNotLookedFor) {
  const auto frame = aisle_.frame(0, Pose{});
  Associations found = no_associations(*frame);
  const int all = match(*frame, Pose{}, found);
  const Associations before = found;
  EXPECT_EQ(match(*frame, Pose{}, found), 0);
  EXPECT_EQ(found, before);
  const int tied = *std::find_if(found[0].begin(), found[0].end(), [](int id) { return id >= 0; });
  truth_.map.remove_landmark(tied);
  found = no_associations(*frame);
  EXPECT_EQ(match(*frame, Pose{}, found), all - 1);
}

TEST_F(ProjectionMatcherTest, LandmarksSeenFromElsewhereAreNotExpected) {
  // The mean viewing direction rotated by more than 60 degrees: another side of the landmark is
  // visible.
  const auto frame = aisle_.frame(0, Pose{});
  Associations found = no_associations(*frame);
  for (Landmark& landmark : truth_.map.landmarks()) {
    const Eigen::Vector3d aside = landmark.normal.unitOrthogonal();
    landmark.normal = (0.4 * landmark.normal + std::sqrt(1 - 0.16) * aside);  // 66 degrees
  }
  EXPECT_EQ(match(*frame, Pose{}, found), 0);
}

}  // namespace
}  // namespace vinebench::slam
