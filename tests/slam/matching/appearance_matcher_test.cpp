// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/matching/appearance_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/util/random.h"

namespace vinebench::slam {
namespace {

Descriptor appearance(int number) {
  const RandomStream random(1, "appearance", static_cast<std::uint64_t>(number));
  return {random.bits(0), random.bits(1), random.bits(2), random.bits(3)};
}

/// The same but for its first bits, 64 at most.
Descriptor appearance(int number, int other_bits) {
  Descriptor descriptor = appearance(number);
  descriptor[0] ^= (std::uint64_t{1} << other_bits) - 1;
  return descriptor;
}

std::shared_ptr<FrameFeatures> frame_of(const std::vector<Descriptor>& descriptors) {
  auto frame = std::make_shared<FrameFeatures>();
  frame->views.resize(1);
  frame->views[0].features.descriptors = descriptors;
  frame->views[0].features.keypoints.resize(descriptors.size());
  frame->views[0].stereo.resize(descriptors.size());
  return frame;
}

/// Keyframes in these places, each with ten landmarks of its own, with the appearances 10 k to 10 k
/// + 9.
Map map_of(const std::vector<Pose>& places) {
  Map map(1.2);
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::vector<Descriptor> own;
    for (int i = 0; i < 10; ++i) own.push_back(appearance(10 * static_cast<int>(k) + i));
    const auto frame = frame_of(own);
    const int id = map.add_keyframe(frame, places[k], no_associations(*frame));
    for (int i = 0; i < 10; ++i) map.add_landmark({0, 0, 1}, {id, 0, i});
  }
  return map;
}

Pose at(double x, double yaw = 0) {
  return {exp_so3({0, 0, yaw}), {x, 0, 0}};
}

std::vector<int> all_of(const Map& map) {
  std::vector<int> ids;
  for (const Landmark& landmark : map.landmarks()) ids.push_back(landmark.id);
  return ids;
}

TEST(MatchByAppearanceTest, EachFeatureGetsTheLandmarkMostLikeIt) {
  const Map map = map_of({at(0)});
  const auto frame = frame_of({appearance(4, 20), appearance(99), appearance(7)});
  // Others are some 128 bits away.
  EXPECT_EQ(match_by_appearance(map, all_of(map), *frame, 64, 0.8)[0],
            (std::vector<int>{4, -1, 7}));
  EXPECT_EQ(match_by_appearance(map, all_of(map), *frame, 19, 0.8)[0],
            (std::vector<int>{-1, -1, 7}));
  EXPECT_EQ(match_by_appearance(map, {1, 2, 3, 4}, *frame, 64, 0.8)[0],
            (std::vector<int>{4, -1, -1}));
}

TEST(MatchByAppearanceTest, TheNextBestMustBeFarther) {
  Map map = map_of({at(0)});
  map.landmark(5).descriptor = appearance(4, 30);
  const auto frame = frame_of({appearance(4, 20)});  // 20 bits from one, 10 from the other
  EXPECT_EQ(match_by_appearance(map, all_of(map), *frame, 64, 0.6)[0][0], 5);
  EXPECT_EQ(match_by_appearance(map, all_of(map), *frame, 64, 0.5)[0][0], -1);
}

TEST(MatchByAppearanceTest, OfTwoFeaturesTheOneMoreAlikeHasTheLandmark) {
  const Map map = map_of({at(0)});
  for (const bool better_first : {true, false}) {
    std::vector<Descriptor> features{appearance(4, 5), appearance(4, 15)};
    if (!better_first) std::swap(features[0], features[1]);
    const auto found = match_by_appearance(map, all_of(map), *frame_of(features), 64, 0.8)[0];
    EXPECT_EQ(found, better_first ? (std::vector<int>{4, -1}) : (std::vector<int>{-1, 4}));
  }
}

TEST(LandmarksAroundTest, AreTheKeyframesAndItsNeighbours) {
  Map map = map_of({at(0), at(1), at(2)});
  // Keyframe 0 gives up two of its landmarks to see two of keyframe 1's.
  for (const int i : {3, 8}) {
    map.remove_landmark(i);
    map.add_observation(10 + i, {0, 0, i});
  }
  const std::vector<int> around = landmarks_around(map, 0);
  EXPECT_TRUE(std::ranges::is_sorted(around));
  EXPECT_EQ(around.size(), 8u + 10u);
  EXPECT_EQ(std::ranges::count(around, 13), 1);
  EXPECT_EQ(std::ranges::count(around, 3), 0);
  EXPECT_EQ(landmarks_around(map, 2).size(), 10u);
}

class KeyframesAlikeTest : public testing::Test {
 protected:
  /// Features with the appearance of these keyframes' landmarks, so many of each.
  static std::shared_ptr<FrameFeatures> seeing(const std::vector<std::pair<int, int>>& keyframes) {
    std::vector<Descriptor> descriptors;
    for (const auto& [keyframe, count] : keyframes) {
      for (int i = 0; i < count; ++i) descriptors.push_back(appearance(10 * keyframe + i, 10));
    }
    return frame_of(descriptors);
  }
};

// 40 landmarks, ten of each keyframe; 25 features vote once (nothing else is within 64 bits), so
// that chance gives each keyframe 25 / 4 = 6.25 votes, and a deviation of sqrt(7.25) = 2.693.
TEST_F(KeyframesAlikeTest, ResemblanceIsTheVotesBeyondChance) {
  const Map map = map_of({at(0), at(1), at(2), at(3)});
  const auto frame = seeing({{0, 5}, {2, 9}, {3, 4}, {1, 7}});
  const std::vector<double> found = resemblance(map, *frame, 100, 64);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_NEAR(found[0], (5 - 6.25) / 2.693, 1e-3);
  EXPECT_NEAR(found[2], (9 - 6.25) / 2.693, 1e-3);
  EXPECT_EQ(resemblance(map, *frame, 100, 9), std::vector<double>(4, 0));  // all are 10 bits off
}

// 15 landmarks, of which the first keyframe has 5, the second 10, and the third 10 of theirs. Four
// votes for the first one's and three for the second one's are four for the third, of which chance
// would give it 7 * 10 / 15 = 4.67, and the first one 2.33.
TEST_F(KeyframesAlikeTest, AKeyframeOfManyLandmarksIsNotMoreAlike) {
  Map map = map_of({at(0), at(1), at(2)});
  for (int i = 5; i < 10; ++i) map.remove_landmark(i);
  for (int i = 20; i < 30; ++i) map.remove_landmark(i);
  for (int i = 0; i < 5; ++i) map.add_observation(i, {2, 0, i});
  for (int i = 10; i < 15; ++i) map.add_observation(i, {2, 0, i - 5});
  std::vector<Descriptor> seen;
  for (const int i : {0, 1, 2, 3, 15, 16, 17}) seen.push_back(appearance(i, 10));
  const std::vector<double> found = resemblance(map, *frame_of(seen), 100, 64);
  EXPECT_NEAR(found[0], (4 - 2.333) / std::sqrt(3.333), 1e-3);
  EXPECT_NEAR(found[1], (3 - 4.667) / std::sqrt(5.667), 1e-3);
  EXPECT_NEAR(found[2], (4 - 4.667) / std::sqrt(5.667), 1e-3);
}

TEST_F(KeyframesAlikeTest, ComeByTheirResemblance) {
  const Map map = map_of({at(0), at(1), at(2), at(3)});
  const std::vector<double> alike{0.5, 1.5, 2.5, -0.5};
  EXPECT_EQ(keyframes_alike(map, alike, 10), (std::vector<int>{2, 1, 0, 3}));
  EXPECT_EQ(keyframes_alike(map, alike, 2), (std::vector<int>{2, 1}));
}

TEST_F(KeyframesAlikeTest, OnePlaceIsGivenOnce) {
  const std::vector<double> alike{3, 2, 1};
  EXPECT_EQ(keyframes_alike(map_of({at(0), at(0.4), at(5)}), alike, 10), (std::vector<int>{0, 2}));
  // The other way round is another place.
  EXPECT_EQ(keyframes_alike(map_of({at(0), at(0.4, 3), at(5)}), alike, 10),
            (std::vector<int>{0, 1, 2}));
}

TEST_F(KeyframesAlikeTest, OfTwoPlacesThatLookTheSameBothAreAlike) {
  Map map = map_of({at(0), at(5), at(10)});
  for (int i = 0; i < 10; ++i) map.landmark(10 + i).descriptor = appearance(i, 4);
  const std::vector<double> found = resemblance(map, *seeing({{0, 8}}), 100, 64);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_GT(found[0], found[2]);
}

TEST_F(KeyframesAlikeTest, QueriesAreSpreadOverTheFrame) {
  const Map map = map_of({at(0), at(5)});
  // Every second of 20 features: five of each keyframe, as chance would have it.
  const auto frame = seeing({{0, 10}, {1, 10}});
  EXPECT_EQ(resemblance(map, *frame, 10, 64), std::vector<double>(2, 0));
}

TEST_F(KeyframesAlikeTest, RemovedLandmarksDoNotVote) {
  Map map = map_of({at(0), at(5)});
  const auto frame = seeing({{0, 6}});
  EXPECT_GT(resemblance(map, *frame, 100, 64)[0], 0);
  for (int i = 0; i < 6; ++i) map.remove_landmark(i);
  EXPECT_EQ(resemblance(map, *frame, 100, 64), std::vector<double>(2, 0));
}

}  // namespace
}  // namespace vinebench::slam
