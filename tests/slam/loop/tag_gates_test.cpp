// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/tag_gates.h"

#include <gtest/gtest.h>

#include "slam/loop/loop_closer.h"
#include "slam/optimisation/bundle_adjustment.h"
#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::distance;
using test::SyntheticAisle;

constexpr int kTagCamera = 4;  // index of the rover's tag camera

/// Gating of sightings by the loop closer.
class TagJudgementTest : public testing::Test {
 protected:
  TagSighting sighting(int id, const Pose& T_body_tag) const {
    const RigCamera& side = rig_.rig.cameras[kTagCamera];
    TagSighting seen;
    seen.camera = kTagCamera;
    seen.family = "tag36h11";
    seen.id = id;
    seen.T_cam_tag = side.T_body_cam.inverse() * T_body_tag;
    for (std::size_t c = 0; c < 4; ++c) {
      seen.corners[c] = side.model.project(seen.T_cam_tag * tag_corners(0.161)[c]);
    }
    return seen;
  }

  /// The tag as seen after it was moved by that much along the row.
  TagSighting shifted(int id, double by) const {
    Pose T_body_tag = T_body_tag_;
    T_body_tag.translation.x() += by;
    return sighting(id, T_body_tag);
  }

  FrameFeatures frame(std::int64_t index, const std::vector<TagSighting>& tags) const {
    FrameFeatures features;
    features.index = index;
    features.stamp = stamp_of_frame(index, 15);
    features.tags = tags;
    return features;
  }

  /// The first frame, a keyframe, sees tag 3.
  void see_first() {
    const auto first = std::make_shared<FrameFeatures>(frame(0, {shifted(3, 0)}));
    EXPECT_TRUE(loop_.gates().gate(*first, body_, 0, map_).empty());
    ASSERT_EQ(first->tags.size(), 1u);
    map_.add_keyframe(first, body_, {});
    loop_.record(*first, body_, 0, map_);
  }

  SyntheticAisle aisle_{0, 1, 10};
  EstimatorRig rig_{aisle_.rig, OrbConfig{}};
  Map map_{1.2};
  LoopCloser loop_{LoopCloserSettings{}, rig_.tag_cameras, {}};
  const Pose T_body_tag_{exp_so3({-1.5, 0.2, 0.1}), {0.1, -0.9, 0.5}};
  const Pose body_{exp_so3({0, 0, 0.4}), {2, 1, 0}};
};

TEST_F(TagJudgementTest, ALoopNeedsTwoFramesInARow) {
  see_first();
  FrameFeatures once = frame(100, {shifted(3, 0.03)});
  EXPECT_TRUE(loop_.gates().gate(once, body_, 5, map_).empty());
  EXPECT_TRUE(once.tags.empty());  // pending
  FrameFeatures gap = frame(101, {});
  loop_.gates().gate(gap, body_, 5, map_);
  FrameFeatures again = frame(102, {shifted(3, 0.03)});
  loop_.gates().gate(again, body_, 5, map_);
  EXPECT_TRUE(again.tags.empty());  // not consecutive
  FrameFeatures elsewhere = frame(103, {shifted(3, -0.05)});
  loop_.gates().gate(elsewhere, body_, 5, map_);
  EXPECT_TRUE(elsewhere.tags.empty());  // 8 cm from where it was a frame ago
  FrameFeatures confirmed = frame(104, {shifted(3, -0.05)});
  loop_.gates().gate(confirmed, body_, 5, map_);
  EXPECT_EQ(confirmed.tags.size(), 1u);
  EXPECT_TRUE(loop_.sees_loop(confirmed, 5));
}

// A tag of 0.16 m at 8 m is 20 px large: its turn is known to some degrees, and with it the body's
// place to half a metre. It is no mistake, but closes no loop yet.
TEST_F(TagJudgementTest, ALoopWaitsForASightingThatIsSure) {
  see_first();
  Pose far = T_body_tag_;
  far.translation = {1, -8, 0.5};
  const Pose there = body_ * T_body_tag_ * far.inverse();
  for (const std::int64_t i : {100, 101, 102}) {
    FrameFeatures seen = frame(i, {sighting(3, far)});
    EXPECT_FALSE(loop_.gates().is_sure(seen.tags[0]));
    EXPECT_TRUE(loop_.gates().gate(seen, there, 20, map_).empty());
    EXPECT_TRUE(seen.tags.empty());
  }
  for (const std::int64_t i : {110, 111}) {
    FrameFeatures seen = frame(i, {shifted(3, 0)});
    EXPECT_TRUE(loop_.gates().is_sure(seen.tags[0]));
    loop_.gates().gate(seen, body_, 28, map_);
    EXPECT_EQ(seen.tags.size(), i == 111 ? 1u : 0u);
  }
}

TEST_F(TagJudgementTest, AMovedTagIsRefused) {
  see_first();
  for (const std::int64_t i : {100, 101, 102}) {
    // After 5 m the drift may be 0.05 + 0.02 x 5 = 0.15 m.
    FrameFeatures moved = frame(i, {shifted(3, 0.25)});
    const auto rejected = loop_.gates().gate(moved, body_, 5, map_);
    ASSERT_EQ(rejected.size(), 1u);
    EXPECT_EQ(rejected[0].reason, TagRejection::kMisplaced);
    EXPECT_EQ(rejected[0].id, 3);
    EXPECT_TRUE(moved.tags.empty());
    EXPECT_FALSE(loop_.sees_loop(moved, 5));
  }
  // It does not relocalise a lost body either.
  EXPECT_FALSE(loop_.gates().map_pose({shifted(3, 0.25)}, map_));
}

TEST_F(TagJudgementTest, TheLongerTheWayTheMoreDriftIsAllowed) {
  see_first();
  const auto accepted = [&](double by, double travelled) {
    FrameFeatures seen = frame(100, {shifted(3, by)});
    return loop_.gates().gate(seen, body_, travelled, map_).empty();
  };
  EXPECT_TRUE(accepted(0.10, 5));
  EXPECT_FALSE(accepted(0.25, 5));
  EXPECT_TRUE(accepted(0.25, 15));  // 0.35 m
  EXPECT_FALSE(accepted(0.6, 15));
}

TEST_F(TagJudgementTest, AfterAnOdometryGapMoreIsAllowed) {
  see_first();
  const auto accepted = [&](double by) {
    FrameFeatures seen = frame(100, {shifted(3, by)});
    return loop_.gates().gate(seen, body_, 5, map_).empty();
  };
  EXPECT_FALSE(accepted(0.25));  // 0.05 + 0.02 x 5 = 0.15 m
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>().diagonal().setConstant(0.04 * 0.04);      // m^2
  covariance.bottomRightCorner<3, 3>().diagonal().setConstant(0.02 * 0.02);  // rad^2
  loop_.gates().cross_gap(3, covariance, 1);
  // In variances: 3 x 0.04^2 and 3 x 0.02^2 x 2^2 m^2 besides (0.15 m / 4.74)^2, together 0.104 m
  // squared: 4.74 of them are 0.49 m.
  EXPECT_TRUE(accepted(0.25));
  EXPECT_FALSE(accepted(0.6));
}

// The tag is 0.6 m from its place: either it was moved, or the body was carried in the gap.
TEST_F(TagJudgementTest, ATagElsewhereAfterAGapTellsWhereTheBodyWouldBe) {
  see_first();
  const std::vector<TagSighting> elsewhere = {shifted(3, 0.6)};
  EXPECT_FALSE(loop_.gates().pose_across_gap(elsewhere, body_, 5, map_));  // no gap
  FrameFeatures second;
  map_.add_keyframe(std::make_shared<FrameFeatures>(second), body_, {});
  map_.keyframe(1).link = OdometryLink{0, {}, 1e-6 * Matrix6d::Identity()};
  loop_.gates().cross_gap(3, 1e-6 * Matrix6d::Identity(), 1);
  EXPECT_FALSE(loop_.gates().pose_across_gap({shifted(3, 0.02)}, body_, 5, map_));  // in its place
  const auto carried = loop_.gates().pose_across_gap(elsewhere, body_, 5, map_);
  ASSERT_TRUE(carried);
  // The body's axes are the map's where it saw the tag first, so it is as far behind.
  EXPECT_LT(distance(*carried, body_ * Pose{{1, 0, 0, 0}, {-0.6, 0, 0}}), 1e-6);

  // Once that is believed, the tag is in place within what the gap leaves open.
  FrameFeatures seen = frame(100, elsewhere);
  EXPECT_EQ(loop_.gates().gate(seen, body_, 5, map_).size(), 1u);
  EXPECT_EQ(loop_.gates().open_gap(elsewhere, map_), 1);
  EXPECT_GT(map_.keyframe(1).link->covariance(0, 0), 100);
  seen = frame(101, elsewhere);
  EXPECT_TRUE(loop_.gates().gate(seen, *carried, 5, map_).empty());
  EXPECT_TRUE(
      loop_.gates().map_pose(elsewhere, map_));  // and it tells the place of a lost body again
}

TEST_F(TagJudgementTest, ATagTurnedOverIsRefused) {
  see_first();
  FrameFeatures turned =
      frame(100, {sighting(3, T_body_tag_ * Pose{exp_so3({0, 0.4, 0}), {0, 0, 0}})});
  EXPECT_EQ(loop_.gates().gate(turned, body_, 5, map_).size(), 1u);  // 23 degrees; 4.5 are allowed
}

TEST_F(TagJudgementTest, OfADuplicateTheOneInPlaceIsBelieved) {
  see_first();
  FrameFeatures both = frame(1, {shifted(3, 0.5), shifted(3, 0)});
  const auto rejected = loop_.gates().gate(both, body_, 0.02, map_);
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_EQ(rejected[0].reason, TagRejection::kMisplaced);
  ASSERT_EQ(both.tags.size(), 1u);
  EXPECT_LT((both.tags[0].corners[0] - shifted(3, 0).corners[0]).norm(), 1e-9);
}

TEST_F(TagJudgementTest, OfADuplicateThatIsNewNoneIsMapped) {
  FrameFeatures both = frame(0, {shifted(3, 0.4), shifted(3, 0), sighting(5, T_body_tag_)});
  const auto rejected = loop_.gates().gate(both, body_, 0, map_);
  ASSERT_EQ(rejected.size(), 2u);
  EXPECT_EQ(rejected[0].reason, TagRejection::kDuplicate);
  ASSERT_EQ(both.tags.size(), 1u);
  loop_.record(both, body_, 0, map_);
  ASSERT_EQ(map_.tags().size(), 1u);
  EXPECT_EQ(map_.tags()[0].id, 5);
}

TEST_F(TagJudgementTest, OneTagInTwoImagesIsNoDuplicate) {
  FrameFeatures both = frame(0, {shifted(3, 0), shifted(3, 0.001)});
  EXPECT_TRUE(loop_.gates().gate(both, body_, 0, map_).empty());
  EXPECT_EQ(both.tags.size(), 2u);
}

TEST_F(TagJudgementTest, AnAmbiguousSightingIsNotMapped) {
  TagSighting seen = shifted(3, 0);
  seen.ambiguous = true;
  FrameFeatures features = frame(0, {seen});
  const auto rejected = loop_.gates().gate(features, body_, 0, map_);
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_EQ(rejected[0].reason, TagRejection::kAmbiguous);
  EXPECT_TRUE(features.tags.empty());
  // It does not localise the body either, in the world or in the map.
  see_first();
  EXPECT_TRUE(loop_.gates().map_pose({shifted(3, 0)}, map_));
  EXPECT_FALSE(loop_.gates().map_pose({seen}, map_));
  const LoopCloser knows(LoopCloserSettings{}, rig_.tag_cameras, {{"tag36h11", 3, 0.161, Pose{}}});
  EXPECT_TRUE(knows.gates().world_pose({shifted(3, 0)}));
  EXPECT_FALSE(knows.gates().world_pose({seen}));
}

TEST_F(TagJudgementTest, ARegisteredTagInAnotherPlaceThanSurveyedIsRefused) {
  Pose T_other = body_ * T_body_tag_;
  T_other.translation.x() += 1;
  LoopCloser loop(LoopCloserSettings{}, rig_.tag_cameras,
                  {{"tag36h11", 3, 0.161, body_ * T_body_tag_}, {"tag36h11", 4, 0.161, T_other}});
  FrameFeatures first = frame(0, {shifted(3, 0)});
  EXPECT_TRUE(loop.gates().gate(first, body_, 0, map_).empty());
  loop.record(first, body_, 0, map_);
  FrameFeatures wrong = frame(1, {shifted(4, 0.2)});  // 0.8 m from where it was surveyed
  ASSERT_EQ(loop.gates().gate(wrong, body_, 0.02, map_).size(), 1u);
  EXPECT_TRUE(wrong.tags.empty());
  EXPECT_EQ(map_.find_tag("tag36h11", 4), nullptr);
}

// A survey of 3 cm and a degree: a tag 0.1 m from its place is nothing strange.
TEST_F(TagJudgementTest, ARoughSurveyAllowsForMore) {
  Pose T_other = body_ * T_body_tag_;
  T_other.translation.x() += 1;
  const std::vector<RegisteredTag> tags = {{"tag36h11", 3, 0.161, body_ * T_body_tag_},
                                           {"tag36h11", 4, 0.161, T_other}};
  for (const double survey : {0.0, 0.03}) {
    LoopConfig config;
    config.survey_position = survey;
    LoopCloser loop({config}, rig_.tag_cameras, tags);
    Map map(1.2);
    loop.record(frame(0, {shifted(3, 0)}), body_, 0, map);
    Pose T_body_other = body_.inverse() * T_other;
    T_body_other.translation.x() += 0.1;
    FrameFeatures seen = frame(1, {sighting(4, T_body_other)});
    EXPECT_EQ(loop.gates().gate(seen, body_, 0.02, map).empty(), survey > 0);
  }
}

/// Four registered tags along a row; the body passes each at the same distance.
class TagDissentInDriveTest : public TagJudgementTest {
 protected:
  TagDissentInDriveTest() {
    for (int id = 0; id < 4; ++id) {
      tags_.push_back({"tag36h11", id, 0.161, at(id) * T_body_tag_});
    }
  }

  /// Of the body beside a tag.
  static Pose at(int id) { return {Eigen::Quaterniond::Identity(), {2.0 * id, 0, 0}}; }

  /// Drives past a tag that stands `off` m further along the row than it was surveyed, in two
  /// frames. Returns where the body was found to have been carried to.
  std::optional<Pose> pass(int id, double off = 0) {
    std::optional<Pose> carried;
    for (int i = 0; i < 2; ++i) {
      FrameFeatures seen = frame(++index_, {shifted(id, off)});
      TagSighting& tag = seen.tags[0];
      tag.id = id;
      const double way = at(id).translation.x();
      loop_.gates().gate(seen, at(id), way, map_);
      carried = loop_.gates().settle_dissent(at(id), map_);
      const auto entered = std::make_shared<FrameFeatures>(seen);
      map_.add_keyframe(entered, at(id), {});
      loop_.record(*entered, at(id), way, map_);
      if (carried) return carried;
    }
    return carried;
  }

  double world_off() const { return map_.world()->translation.x(); }

  std::vector<RegisteredTag> tags_;
  std::int64_t index_ = 0;
  LoopCloser loop_{LoopCloserSettings{}, rig_.tag_cameras, {}};
  void start() { loop_ = LoopCloser(LoopCloserSettings{}, rig_.tag_cameras, tags_); }
};

// The first tag hangs 0.8 m from where it was surveyed, and says so where the map lies.
TEST_F(TagDissentInDriveTest, TwoThatAgreeAreBelievedAgainstOne) {
  start();
  pass(0, 0.8);
  EXPECT_NEAR(world_off(), 0.8, 1e-9);
  pass(1);
  EXPECT_NEAR(world_off(), 0.8, 1e-9);  // one against one
  pass(2);
  EXPECT_NEAR(world_off(), 0, 1e-9);
  // It stays in the map as a tag that nobody surveyed, where it is seen.
  const MapTag* first = map_.find_tag("tag36h11", 0);
  ASSERT_NE(first, nullptr);
  EXPECT_FALSE(first->registered());
  EXPECT_NEAR(first->T_map_tag.translation.x(), tags_[0].T_world_tag.translation.x() + 0.8, 1e-9);
  // The others are believed from now on.
  pass(3);
  ASSERT_NE(map_.find_tag("tag36h11", 3), nullptr);
  EXPECT_TRUE(map_.find_tag("tag36h11", 3)->fixed);
  FrameFeatures again = frame(++index_, {shifted(1, 0)});
  EXPECT_TRUE(loop_.gates().map_pose(again.tags, map_));
}

TEST_F(TagDissentInDriveTest, ThoseThatHangElsewhereEachInItsOwnWayAreNot) {
  start();
  pass(0);
  pass(1, 0.8);
  pass(2, -0.7);
  pass(3, 1.6);
  EXPECT_NEAR(world_off(), 0, 1e-9);
  EXPECT_TRUE(map_.find_tag("tag36h11", 0)->fixed);
  EXPECT_EQ(map_.tags().size(), 1u);
}

TEST_F(TagDissentInDriveTest, TwoAgainstTwoChangeNothing) {
  start();
  pass(0);
  pass(1);
  pass(2, 0.8);
  pass(3, 0.8);
  EXPECT_NEAR(world_off(), 0, 1e-9);
  EXPECT_EQ(map_.tags().size(), 2u);
}

// Carried in a gap by 0.8 m back: all tags after it seem to hang 0.8 m further.
TEST_F(TagDissentInDriveTest, TwoThatAgreeAfterAGapSayThatTheBodyWasCarried) {
  start();
  pass(0);
  pass(1);
  map_.add_keyframe(std::make_shared<FrameFeatures>(), at(1), {});
  const int after = static_cast<int>(map_.keyframes().size()) - 1;
  map_.keyframe(after).link = OdometryLink{after - 1, {}, 1e-6 * Matrix6d::Identity()};
  loop_.gates().cross_gap(3, 1e-6 * Matrix6d::Identity(), after);
  EXPECT_FALSE(pass(2, 0.8));
  const auto carried = pass(3, 0.8);
  ASSERT_TRUE(carried);
  EXPECT_LT(distance(*carried, at(3) * Pose{{1, 0, 0, 0}, {-0.8, 0, 0}}), 1e-9);
  EXPECT_NEAR(world_off(), 0, 1e-9);
  EXPECT_TRUE(map_.find_tag("tag36h11", 0)->fixed);
}

}  // namespace
}  // namespace vinebench::slam
