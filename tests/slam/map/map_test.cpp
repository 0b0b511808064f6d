// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/map/map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace vinebench::slam {
namespace {

/// A frame of `views` views with ten features each, feature i of view v with the bit 10 v + i set.
std::shared_ptr<const FrameFeatures> frame(std::size_t views = 2) {
  auto features = std::make_shared<FrameFeatures>();
  features->views.resize(views);
  for (std::size_t v = 0; v < views; ++v) {
    StereoView& view = features->views[v];
    for (std::size_t i = 0; i < 10; ++i) {
      view.features.keypoints.push_back({});
      view.features.descriptors.push_back({std::uint64_t{1} << (10 * v + i), 0, 0, 0});
      view.stereo.push_back({});
    }
  }
  return features;
}

class MapTest : public testing::Test {
 protected:
  MapTest() {
    for (int i = 0; i < 3; ++i) map_.add_keyframe(frame(), Pose{}, {});
  }

  /// Consistency: each observation is stored at its feature and each associated feature in its
  /// landmark's observations; covisibility counts equal a recount.
  void expect_consistent() const {
    std::size_t tied = 0;
    for (const Keyframe& k : map_.keyframes()) {
      for (std::size_t v = 0; v < k.landmarks.size(); ++v) {
        for (std::size_t f = 0; f < k.landmarks[v].size(); ++f) {
          if (k.landmarks[v][f] < 0) continue;
          ++tied;
          EXPECT_FALSE(map_.landmark(k.landmarks[v][f]).removed);
        }
      }
    }
    std::map<std::pair<int, int>, int> shared;
    for (const Landmark& landmark : map_.landmarks()) {
      std::set<int> seen_by;
      for (const Observation& o : landmark.observations) {
        --tied;
        seen_by.insert(o.keyframe);
        EXPECT_EQ(slot(o), landmark.id);
      }
      EXPECT_EQ(count_keyframes(landmark), static_cast<int>(seen_by.size()));
      EXPECT_EQ(landmark.observations.empty(), landmark.removed);
      for (const int a : seen_by) {
        for (const int b : seen_by) {
          if (a != b) ++shared[{a, b}];
        }
      }
    }
    EXPECT_EQ(tied, 0u);
    std::map<std::pair<int, int>, int> kept;
    for (const Keyframe& k : map_.keyframes()) {
      for (const auto& [other, count] : k.covisible) kept[{k.id, other}] = count;
    }
    EXPECT_EQ(kept, shared);
  }

  int slot(const Observation& o) const {
    return map_.keyframe(o.keyframe)
        .landmarks[static_cast<std::size_t>(o.view)][static_cast<std::size_t>(o.feature)];
  }

  Map map_{1.2};
};

TEST_F(MapTest, ObservationsAreKeptOnBothSidesInOrder) {
  const int id = map_.add_landmark({1, 2, 3}, {1, 0, 4});
  EXPECT_TRUE(map_.add_observation(id, {2, 1, 0}));
  EXPECT_TRUE(map_.add_observation(id, {0, 0, 9}));
  EXPECT_TRUE(map_.add_observation(id, {1, 1, 3}));  // the other pair of a keyframe sees it too
  const auto& seen = map_.landmark(id).observations;
  ASSERT_EQ(seen.size(), 4u);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_LT(std::tie(seen[i - 1].keyframe, seen[i - 1].view),
              std::tie(seen[i].keyframe, seen[i].view));
  }
  EXPECT_EQ(map_.landmark(id).first_keyframe, 1);
  EXPECT_EQ(count_keyframes(map_.landmark(id)), 3);
  expect_consistent();
}

TEST_F(MapTest, LandmarksAreFoundByTheKeyframeTheyBeganWith) {
  const int first = map_.add_landmark({1, 0, 0}, {0, 0, 1});
  const int second = map_.add_landmark({2, 0, 0}, {2, 0, 2});
  const int third = map_.add_landmark({3, 0, 0}, {2, 1, 3});
  map_.add_observation(second, {0, 0, 4});  // it began with keyframe 2 all the same
  map_.remove_landmark(third);
  ASSERT_EQ(map_.begun_with(0).size(), 1u);
  EXPECT_EQ(map_.begun_with(0)[0].id, first);
  EXPECT_TRUE(map_.begun_with(1).empty());
  ASSERT_EQ(map_.begun_with(2).size(), 2u);
  EXPECT_EQ(map_.begun_with(2)[0].id, second);
  EXPECT_TRUE(map_.begun_with(2)[1].removed);
}

TEST_F(MapTest, ATakenEndIsNotTakenAgain) {
  const int a = map_.add_landmark({1, 0, 0}, {0, 0, 1});
  const int b = map_.add_landmark({2, 0, 0}, {0, 0, 2});
  EXPECT_FALSE(map_.add_observation(b, {0, 0, 1}));  // the feature is a's
  EXPECT_FALSE(map_.add_observation(a, {0, 0, 3}));  // that view sees a at feature 1
  EXPECT_EQ(slot({0, 0, 1}), a);
  EXPECT_EQ(slot({0, 0, 3}), -1);
  expect_consistent();
}

TEST_F(MapTest, CovisibilityCountsLandmarksNotObservations) {
  const int a = map_.add_landmark({1, 0, 0}, {0, 0, 1});
  map_.add_observation(a, {0, 1, 1});
  map_.add_observation(a, {1, 0, 1});
  map_.add_observation(a, {1, 1, 1});
  const int b = map_.add_landmark({2, 0, 0}, {0, 0, 2});
  map_.add_observation(b, {1, 0, 2});
  map_.add_observation(b, {2, 0, 2});
  EXPECT_EQ(map_.keyframe(0).covisible, (std::map<int, int>{{1, 2}, {2, 1}}));
  EXPECT_EQ(map_.keyframe(2).covisible, (std::map<int, int>{{0, 1}, {1, 1}}));
  EXPECT_EQ(map_.covisible(0, 10), (std::vector<int>{1, 2}));
  EXPECT_EQ(map_.covisible(2, 10), (std::vector<int>{0, 1}));  // ties in order of id
  EXPECT_EQ(map_.covisible(0, 1), (std::vector<int>{1}));
  EXPECT_EQ(map_.count_landmarks(2), 2u);
  EXPECT_EQ(map_.count_landmarks(3), 1u);
  expect_consistent();
}

TEST_F(MapTest, RemovalLeavesNoTrace) {
  const int a = map_.add_landmark({1, 0, 0}, {0, 0, 1});
  map_.add_observation(a, {1, 0, 1});
  map_.add_observation(a, {1, 1, 1});
  map_.remove_observation(a, {1, 0, 1});
  EXPECT_EQ(map_.keyframe(0).covisible.at(1), 1);  // the other view still sees it
  expect_consistent();
  map_.remove_observation(a, {1, 1, 1});
  EXPECT_TRUE(map_.keyframe(0).covisible.empty());
  EXPECT_FALSE(map_.landmark(a).removed);
  map_.remove_observation(a, {0, 0, 1});
  EXPECT_TRUE(map_.landmark(a).removed);  // no observation is left
  expect_consistent();

  const int b = map_.add_landmark({1, 0, 0}, {0, 0, 1});
  map_.add_observation(b, {2, 1, 7});
  map_.remove_landmark(b);
  EXPECT_TRUE(map_.landmark(b).removed);
  EXPECT_EQ(slot({2, 1, 7}), -1);
  EXPECT_EQ(map_.count_landmarks(1), 0u);
  expect_consistent();
}

TEST_F(MapTest, MergingKeepsWhatIsFree) {
  const int from = map_.add_landmark({1, 0, 0}, {0, 0, 1});
  map_.add_observation(from, {1, 0, 1});
  map_.add_observation(from, {2, 1, 1});
  const int into = map_.add_landmark({1, 0, 0.01}, {1, 0, 2});
  map_.merge(from, into);
  EXPECT_TRUE(map_.landmark(from).removed);
  EXPECT_EQ(slot({0, 0, 1}), into);
  EXPECT_EQ(slot({2, 1, 1}), into);
  EXPECT_EQ(slot({1, 0, 1}), -1);  // keyframe 1 saw `into` at feature 2 already
  EXPECT_EQ(slot({1, 0, 2}), into);
  EXPECT_EQ(map_.keyframe(0).covisible, (std::map<int, int>{{1, 1}, {2, 1}}));
  expect_consistent();
}

TEST_F(MapTest, ANewKeyframeIsTiedToWhatItTracked) {
  const int a = map_.add_landmark({1, 0, 0}, {0, 0, 1});
  const int gone = map_.add_landmark({1, 0, 0}, {0, 0, 2});
  map_.remove_landmark(gone);
  const auto next = frame();
  Associations tracked = no_associations(*next);
  tracked[1][5] = a;
  tracked[0][5] = gone;
  const int id = map_.add_keyframe(next, Pose{Eigen::Quaterniond::Identity(), {1, 0, 0}}, tracked);
  EXPECT_EQ(id, 3);
  EXPECT_EQ(slot({3, 1, 5}), a);
  EXPECT_EQ(slot({3, 0, 5}), -1);
  expect_consistent();
}

TEST_F(MapTest, RefreshTakesTheMedianDescriptorTheMeanDirectionAndTheReach) {
  // Seen by cameras at (0, 0, 0) and (2, 0, 0) from either side: together from straight below.
  map_.keyframe(1).T_map_body.translation = {2, 0, 0};
  const int id = map_.add_landmark({1, 0, 1}, {0, 0, 1});
  auto later = std::make_shared<FrameFeatures>(*frame());
  later->views[0].features.keypoints[1].level = 2;
  later->views[0].features.descriptors[1] = {0xff, 0, 0, 0};
  const int k = map_.add_keyframe(later, Pose{Eigen::Quaterniond::Identity(), {1, 0, -1}}, {});
  map_.add_observation(id, {1, 0, 1});
  map_.add_observation(id, {k, 0, 1});
  map_.refresh(id, {Pose{}, Pose{}});
  const Landmark& landmark = map_.landmark(id);
  EXPECT_LT((landmark.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-14);
  // Two of the three descriptors are the same, the different one is not chosen.
  EXPECT_EQ(landmark.descriptor, frame()->views[0].features.descriptors[1]);
  // The last one sees it 2 m away on level 2: on level 0 it would be seen 1.44 times as far.
  EXPECT_NEAR(landmark.max_distance, 2 * 1.44, 1e-12);
  // With all cameras 1 m farther down the last one is 3 m away; the map stays as it is.
  const auto farther = [&](int keyframe) {
    return Pose{Eigen::Quaterniond::Identity(), {0, 0, -1}} * map_.keyframe(keyframe).T_map_body;
  };
  EXPECT_NEAR(map_.look_of(landmark, farther, {Pose{}, Pose{}}).max_distance, 3 * 1.44, 1e-12);
  EXPECT_NEAR(landmark.max_distance, 2 * 1.44, 1e-12);
}

TEST_F(MapTest, TheOnlyRegisteredTagAndFixedOnesHoldTheMap) {
  map_.tags() = {{"a", 1, 0.1, {}}, {"a", 2, 0.1, {}}};
  map_.tags()[1].survey = SurveyedPlace{};
  EXPECT_FALSE(map_.is_held(map_.tags()[0]));  // nobody surveyed it
  EXPECT_TRUE(map_.is_held(map_.tags()[1]));
  map_.tags().push_back({"a", 3, 0.1, {}, true});
  EXPECT_FALSE(map_.is_held(map_.tags()[1]));
  EXPECT_TRUE(map_.is_held(map_.tags()[2]));
}

TEST_F(MapTest, TagsAreFoundByFamilyAndId) {
  map_.tags().push_back({"tag36h11", 3, 0.161, {}, false});
  EXPECT_EQ(map_.find_tag("tag36h11", 3), map_.tags().data());
  EXPECT_EQ(map_.find_tag("tag36h11", 4), nullptr);
  EXPECT_EQ(map_.find_tag("tag25h9", 3), nullptr);
}

}  // namespace
}  // namespace vinebench::slam
