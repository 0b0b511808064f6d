// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/geometry/step_covariance.h"
#include "core/util/error.h"
#include "tests/support/loop_closure_case.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::distance;
using test_case::LoopClosureTest;

TEST_F(LoopClosureTest, TiesTheTwoVisitsTogether) {
  LoopCloser loop = closer();
  const LoopClosure closure = drive_and_close(loop, false);
  EXPECT_EQ(closure.tag_id, 0);
  EXPECT_EQ(closure.earlier, 0);
  EXPECT_EQ(closure.later, stamp_of_frame(150, 15));
  const Pose moved = truth_[0].inverse() * truth_[5];
  EXPECT_LT(distance(closure.T_earlier_later, moved), 1e-12);
  EXPECT_NEAR(closure.correction, 0.05, 1e-5);  // five steps of 1 cm
  // Both sightings contribute: without the later one's part it is still a covariance.
  const Pose T_body_tag = truth_[5].inverse() * T_world_tag_;
  TagSighting seen = with_corners(sighting(0, T_body_tag));
  const Matrix6d one =
      carry_covariance(tag_covariance(seen, 0.161, rig_.tag_cameras, settings_.loop.corner_sigma),
                       T_body_tag.inverse());
  ASSERT_TRUE(closure.covariance);
  EXPECT_EQ(Eigen::LLT<Matrix6d>(*closure.covariance - one).info(), Eigen::Success);
  expect_true_poses();
  // After the closure the visit continues.
  EXPECT_FALSE(loop.sees_loop(*keyframe(5, false), 2.5));
}

TEST_F(LoopClosureTest, TheTagThatWasLeftClosesItWhateverElseIsInView) {
  LoopCloser loop = closer();
  const LoopClosure closure = drive_and_close(loop, true);
  EXPECT_EQ(closure.tag_id, 0);  // tag 1 was in view at the previous keyframe
  EXPECT_EQ(closure.earlier, 0);
  expect_true_poses();
}

// Keyframes are 2 s apart, and a tag unseen for 3 s was left: 0 and 1 are one visit. The sighting
// with corners of 1 px says less of where the tag is than the other, from as near.
TEST_F(LoopClosureTest, TheSurestSightingOfTheEarlierVisitClosesIt) {
  for (const int rough : {0, 1}) {
    AisleMap known(aisle_, {});
    LoopCloser loop = closer();
    for (const int k : {0, 1, 4}) {
      const auto i = static_cast<std::size_t>(k);
      FrameFeatures features = *aisle_.frame_with_tag(30 * k, truth_[i], T_world_tag_);
      if (k == rough) features.tags[0].corner_sigma = 1;
      const auto frame = std::make_shared<FrameFeatures>(features);
      const int id = known.add(frame, truth_[i]);
      if (k < 4) {
        loop.record(*frame, truth_[i], 0.5 * k, known.map);
        continue;
      }
      const LoopClosure closure = loop.close(id, 0.5 * k, known.rig, known.map);
      EXPECT_EQ(closure.earlier, stamp_of_frame(30 * (1 - rough), 15)) << rough;
    }
  }
}

// What an earlier visit saw, and however well, is tied already by the loop that ended it.
TEST_F(LoopClosureTest, OnlyTheLastVisitClosesIt) {
  LoopCloser loop = closer();
  for (const int k : {0, 3, 5}) {
    const auto i = static_cast<std::size_t>(k);
    FrameFeatures features = *aisle_.frame_with_tag(30 * k, truth_[i], T_world_tag_);
    if (k == 3) features.tags[0].corner_sigma = 1;
    const auto frame = std::make_shared<FrameFeatures>(features);
    const int id = known_.add(frame, truth_[i]);
    if (k == 0) {
      loop.record(*frame, truth_[i], 0, known_.map);
      continue;
    }
    const LoopClosure closure = loop.close(id, 0.5 * k, known_.rig, known_.map);
    EXPECT_EQ(closure.earlier, stamp_of_frame(k == 3 ? 0 : 90, 15)) << k;
  }
}

TEST_F(LoopClosureTest, ARegisteredTagThatIsNewClosesItWithTheLastOne) {
  // Tag 0 is in view at the first keyframe only, tag 7 at the last only; the world is the map.
  const Pose T_world_new = truth_[5] * T_body_tag_;
  LoopCloser loop =
      closer({{"tag36h11", 0, 0.161, T_world_tag_}, {"tag36h11", 7, 0.161, T_world_new}});
  for (int k = 0; k < 5; ++k) {
    const auto features = keyframe(k, false);
    known_.add(features, drifted(k));
    loop.record(*features, drifted(k), 0.5 * k, known_.map);
  }
  auto last = std::make_shared<FrameFeatures>(*aisle_.frame(150, truth_[5]));
  last->tags.push_back(with_corners(sighting(7, T_body_tag_)));
  ASSERT_TRUE(loop.sees_loop(*last, 2.5));
  const LoopClosure closure = loop.close(known_.add(last, drifted(5)), 2.5, known_.rig, known_.map);
  EXPECT_EQ(closure.tag_id, 7);
  EXPECT_EQ(closure.earlier, 0);
  // With two tags the closure is taken from the adjusted map, which is accurate to 1e-6. How sure
  // it is of that is not known.
  EXPECT_FALSE(closure.covariance);
  const Pose moved = truth_[0].inverse() * truth_[5];
  EXPECT_LT(distance(closure.T_earlier_later, moved), 1e-6);
  EXPECT_EQ(distance(closure.T_earlier_later, known_.map.keyframe(0).T_map_body.inverse() *
                                                  known_.map.keyframe(5).T_map_body),
            0);
  expect_true_poses();
}

// Five keyframes at their true poses, then one beside the second that tracking took to be 5 cm
// aside, without any of their landmarks.
TEST_F(LoopClosureTest, APlaceFoundAgainTiesItToWhatWasMappedThere) {
  for (int k = 0; k < 5; ++k) {
    known_.add(aisle_.frame(30 * k, truth_[static_cast<std::size_t>(k)]),
               truth_[static_cast<std::size_t>(k)]);
  }
  const Pose there = truth_[1] * Pose{exp_so3({0, 0, 0.01}), {0.01, 0, 0}};
  const auto frame = aisle_.frame(300, there);
  const Pose off{exp_so3({0, 0, 0.005}), {0.03, 0.04, 0}};
  const int id = known_.map.add_keyframe(frame, there * off, no_associations(*frame));
  PlaceReturn place;
  place.earlier = 1;
  place.T_map_body = there;
  place.covariance = 1e-8 * Matrix6d::Identity();
  place.landmarks = landmark_ids(known_.map.keyframe(1).landmarks);
  const LoopClosure closure = closer().close(place, id, LocalMapper({}), known_.rig, known_.map);
  EXPECT_EQ(closure.tag_id, -1);
  EXPECT_EQ(closure.earlier, stamp_of_frame(30, 15));
  EXPECT_LT(distance(closure.T_earlier_later, truth_[1].inverse() * there), 1e-12);
  EXPECT_NEAR(closure.correction, 0.05, 1e-4);
  EXPECT_TRUE(closure.covariance);
  // Pixels are exact, as landmarks are: what is tied holds the pose.
  EXPECT_GT(landmark_ids(known_.map.keyframe(id).landmarks).size(), 100u);
  EXPECT_LT(distance(known_.map.keyframe(id).T_map_body, there), 1e-5);
}

TEST_F(LoopClosureTest, WithoutALoopThereIsNothingToClose) {
  LoopCloser loop = closer();
  const int id = known_.add(keyframe(0, false), truth_[0]);
  EXPECT_THAT([&] { loop.close(id, 0, known_.rig, known_.map); },
              testing::ThrowsMessage<Error>(testing::HasSubstr("keyframe 0")));
}

}  // namespace
}  // namespace vinebench::slam
