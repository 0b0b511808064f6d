// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/loop_closer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numbers>

#include "core/util/error.h"
#include "slam/optimisation/bundle_adjustment.h"
#include "slam/optimisation/gravity_fit.h"
#include "tests/support/aisle_map.h"
#include "tests/support/swinging_body.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::angle;
using test::distance;
using test::SwingingBody;
using test::SyntheticAisle;

constexpr int kSide = 4;  // index of the rover's tag camera

class LoopCloserTest : public testing::Test {
 protected:
  LoopCloser closer(const std::vector<RegisteredTag>& tags = {}) const {
    return {settings_, rig_.tag_cameras, tags};
  }

  /// A sighting of a tag that stands at T_body_tag.
  TagSighting sighting(int id, const Pose& T_body_tag) const {
    TagSighting seen;
    seen.camera = kSide;
    seen.family = "tag36h11";
    seen.id = id;
    seen.T_cam_tag = rig_.rig.cameras[kSide].T_body_cam.inverse() * T_body_tag;
    return seen;
  }

  TagSighting with_corners(TagSighting seen) const {
    const RigCamera& side = rig_.rig.cameras[kSide];
    for (std::size_t c = 0; c < 4; ++c) {
      seen.corners[c] = side.model.project(seen.T_cam_tag * tag_corners(0.161)[c]);
    }
    return seen;
  }

  std::shared_ptr<const FrameFeatures> frame(std::int64_t index,
                                             const std::vector<TagSighting>& tags) const {
    auto features = std::make_shared<FrameFeatures>();
    features->index = index;
    features->stamp = stamp_of_frame(index, 15);
    features->tags = tags;
    return features;
  }

  SyntheticAisle aisle_{0, 1, 600};
  EstimatorRig rig_{aisle_.rig, OrbConfig{}};
  LoopCloserSettings settings_;
  Map map_{1.2};
  const Pose T_body_tag_{exp_so3({-1.5, 0.2, 0.1}), {0.1, -0.7, 0.5}};
  const Pose body_{exp_so3({0, 0, 0.4}), {2, 1, 0}};
};

TEST_F(LoopCloserTest, ALoadedMapLiesInTheWorldAsItsRegisteredTagSays) {
  const Pose T_map_world{exp_so3({0, 0, 0.3}), {1, 2, 0}};
  const RegisteredTag first{"tag36h11", 1, 0.161, Pose{{1, 0, 0, 0}, {3, 0, 0.5}}};
  const RegisteredTag second{"tag36h11", 2, 0.161, Pose{{1, 0, 0, 0}, {5, 1, 0.5}}};
  map_.tags().push_back({"tag36h11", 1, 0.161, T_map_world * first.T_world_tag, true});
  LoopCloser loop = closer({first, second});
  loop.gates().take_over(map_);
  // With a body pose off by 0.1 m, the tag is still at its registered pose.
  const Pose T_map_tag = T_map_world * second.T_world_tag;
  Pose estimated = T_map_tag * T_body_tag_.inverse();
  estimated.translation.x() += 0.1;
  loop.record(*frame(0, {sighting(2, T_body_tag_)}), estimated, 0, map_);
  ASSERT_EQ(map_.tags().size(), 2u);
  EXPECT_LT(distance(map_.tags()[1].T_map_tag, T_map_tag), 1e-12);
}

// Where tags were surveyed to a centimetre each, a loaded map lies in the world as all of them say:
// the one is 2 cm too far along x, the other 2 cm short.
TEST_F(LoopCloserTest, ALoadedMapLiesInTheWorldAsItsTagsSayOnAverage) {
  const RegisteredTag first{"tag36h11", 1, 0.161, Pose{{1, 0, 0, 0}, {3, 0, 0.5}}, {0.01, 0.01}};
  const RegisteredTag second{"tag36h11", 2, 0.161, Pose{{1, 0, 0, 0}, {5, 0, 0.5}}, {0.01, 0.01}};
  for (const auto& [tag, off] : {std::pair(first, 0.02), {second, -0.02}}) {
    Pose found = tag.T_world_tag;
    found.translation.x() += off;
    map_.tags().push_back({"tag36h11", tag.id, 0.161, found, true});
  }
  LoopCloser loop = closer({first, second});
  loop.gates().take_over(map_);
  ASSERT_TRUE(map_.world());
  EXPECT_LT(distance(*map_.world(), Pose{}), 1e-9);
  EXPECT_FALSE(map_.tags()[0].fixed);
  ASSERT_TRUE(map_.tags()[0].survey);
  EXPECT_EQ(map_.tags()[0].survey->T_world_tag.translation.x(), 3);
}

// The map's pose in the world is that which the first registered tag gives, whatever comes after.
TEST_F(LoopCloserTest, TheFirstRegisteredTagGivesTheWorld) {
  const Pose T_world_tag{exp_so3({0.1, 0.2, 0.3}), {10, 20, 0.5}};
  LoopCloser loop = closer({{"tag36h11", 0, 0.2, T_world_tag}});
  loop.record(*frame(0, {sighting(9, T_body_tag_)}), body_, 0, map_);
  EXPECT_FALSE(map_.world());
  const TagSighting known = sighting(0, T_body_tag_);
  loop.record(*frame(1, {known}), body_, 0, map_);
  ASSERT_TRUE(map_.world());
  const Pose T_map_world = *map_.world();
  const Pose T_world_seen = T_map_world.inverse() * body_ * T_body_tag_;
  EXPECT_LT(distance(T_world_seen, T_world_tag), 1e-12);
  EXPECT_LT(angle(T_world_seen, T_world_tag), 1e-7);  // acos near 1
  loop.record(*frame(2, {known}), Pose{}, 0, map_);
  EXPECT_EQ(distance(*map_.world(), T_map_world), 0);
}

// A degree of the tag's survey turns the body about the tag: at the distance d of the tag's origin
// that moves it by a degree times d across the line between them, twice (two axes): 2 d^2 of the
// trace, beside 3 times the square of the position's own.
TEST_F(LoopCloserTest, TheSurveyOfARegisteredTagIsPartOfWhereTheBodyIs) {
  const TagSighting seen = with_corners(sighting(0, T_body_tag_));
  const RegisteredTag tag{"tag36h11", 0, 0.161, Pose{}};
  const Matrix6d by_corners = closer({tag}).gates().localisation_covariance({seen});
  settings_.loop.survey_position = 0.006;
  settings_.loop.survey_rotation_deg = 1;
  const Matrix6d survey = closer({tag}).gates().localisation_covariance({seen}) - by_corners;
  const double turn = std::numbers::pi / 180;
  const double d = T_body_tag_.translation.norm();
  EXPECT_NEAR((survey.topLeftCorner<3, 3>().trace()), 3 * 0.006 * 0.006 + 2 * turn * turn * d * d,
              1e-12);
  EXPECT_NEAR((survey.bottomRightCorner<3, 3>().trace()), 3 * turn * turn, 1e-12);
  // A tag that nobody surveyed lies where the map has it.
  EXPECT_EQ(closer().gates().localisation_covariance({seen}), by_corners);
}

TEST_F(LoopCloserTest, AnUnregisteredTagIsMappedAtFirstSight) {
  LoopCloser loop = closer();
  loop.record(*frame(0, {sighting(3, T_body_tag_)}), body_, 0, map_);
  ASSERT_EQ(map_.tags().size(), 1u);
  const MapTag tag = map_.tags()[0];
  EXPECT_EQ(tag.id, 3);
  EXPECT_EQ(tag.size, settings_.tag_size);
  EXPECT_FALSE(tag.fixed);
  EXPECT_LT(distance(tag.T_map_tag, body_ * T_body_tag_), 1e-14);
  // A second sighting with a slightly wrong pose does not move it.
  loop.record(*frame(1, {sighting(3, T_body_tag_)}), Pose{}, 0, map_);
  ASSERT_EQ(map_.tags().size(), 1u);
  EXPECT_EQ(distance(map_.tags()[0].T_map_tag, tag.T_map_tag), 0);
}

TEST_F(LoopCloserTest, RegisteredTagsKeepTheirPlacesAgainstEachOther) {
  const Pose T_world_a{exp_so3({0.1, 0.2, 0.3}), {10, 20, 0.5}};
  const Pose T_world_b{exp_so3({0.3, 0.1, 0.2}), {11, 22, 0.7}};
  LoopCloser loop = closer({{"tag36h11", 0, 0.2, T_world_a}, {"tag36h11", 1, 0.3, T_world_b}});
  loop.record(*frame(0, {sighting(0, T_body_tag_)}), body_, 0, map_);
  // The second is seen at a wrong pose: the registered pose is used.
  loop.record(*frame(1, {sighting(1, T_body_tag_)}), body_, 0, map_);
  ASSERT_EQ(map_.tags().size(), 2u);
  EXPECT_TRUE(map_.tags()[0].fixed);
  EXPECT_EQ(map_.tags()[1].size, 0.3);
  const Pose T_a_b = map_.tags()[0].T_map_tag.inverse() * map_.tags()[1].T_map_tag;
  EXPECT_LT(distance(T_a_b, T_world_a.inverse() * T_world_b), 1e-12);
  EXPECT_LT(distance(map_.tags()[0].T_map_tag, body_ * T_body_tag_), 1e-12);
}

TEST_F(LoopCloserTest, ATagThatWasSurveyedRoughlyIsMappedWhereItIsSeen) {
  settings_.loop.survey_position = 0.01;
  const Pose T_world_b{exp_so3({0.3, 0.1, 0.2}), {1, 0, 0}};
  LoopCloser loop = closer({{"tag36h11", 0, 0.2, Pose{}}, {"tag36h11", 1, 0.3, T_world_b}});
  loop.record(*frame(0, {sighting(0, T_body_tag_)}), body_, 0, map_);
  loop.record(*frame(1, {sighting(1, T_body_tag_)}), body_, 0, map_);
  ASSERT_EQ(map_.tags().size(), 2u);
  EXPECT_FALSE(map_.tags()[1].fixed);
  ASSERT_TRUE(map_.tags()[1].survey);
  EXPECT_EQ(distance(map_.tags()[1].survey->T_world_tag, T_world_b), 0);
  EXPECT_DOUBLE_EQ(map_.tags()[1].survey->covariance(0, 0), 1e-4);
  EXPECT_EQ(map_.tags()[1].size, 0.3);
  EXPECT_LT(distance(map_.tags()[1].T_map_tag, body_ * T_body_tag_), 1e-12);
}

TEST_F(LoopCloserTest, ATagTellsWhereTheBodyIs) {
  const Pose T_world_tag{exp_so3({0.1, 0.2, 0.3}), {10, 20, 0.5}};
  LoopCloser loop = closer({{"tag36h11", 0, 0.2, T_world_tag}});
  const TagSighting known = sighting(0, T_body_tag_);
  EXPECT_FALSE(loop.gates().world_pose({sighting(9, T_body_tag_)}));
  const auto in_world = loop.gates().world_pose({sighting(9, Pose{}), known});
  ASSERT_TRUE(in_world);
  EXPECT_LT(distance(*in_world * T_body_tag_, T_world_tag), 1e-12);

  EXPECT_FALSE(loop.gates().map_pose({known}, map_));
  loop.record(*frame(0, {known}), body_, 0, map_);
  const auto in_map = loop.gates().map_pose({known}, map_);
  ASSERT_TRUE(in_map);
  EXPECT_LT(distance(*in_map, body_), 1e-12);
  EXPECT_LT(angle(*in_map, body_), 1e-7);
}

TEST_F(LoopCloserTest, ATagThatWasLeftAndIsSeenAgainIsALoop) {
  LoopCloser loop = closer();
  const auto first = frame(0, {sighting(3, T_body_tag_)});
  EXPECT_FALSE(loop.sees_loop(*first, 0));
  map_.add_keyframe(first, body_, {});
  loop.record(*first, body_, 0, map_);
  // Three seconds are 45 frames; the path is at least a metre.
  EXPECT_FALSE(loop.sees_loop(*frame(44, {sighting(3, T_body_tag_)}), 5.0));
  EXPECT_FALSE(loop.sees_loop(*frame(45, {sighting(3, T_body_tag_)}), 0.99));
  EXPECT_TRUE(loop.sees_loop(*frame(45, {sighting(3, T_body_tag_)}), 1.0));
  EXPECT_FALSE(loop.sees_loop(*frame(45, {sighting(4, T_body_tag_)}), 1.0));
  EXPECT_FALSE(loop.sees_loop(*frame(45, {}), 1.0));
  // It remains a revisit until the loop is closed.
  loop.record(*frame(45, {sighting(3, T_body_tag_)}), body_, 1.0, map_);
  EXPECT_TRUE(loop.sees_loop(*frame(46, {sighting(3, T_body_tag_)}), 1.02));
}

TEST_F(LoopCloserTest, OutOfViewForAMomentIsNotLeft) {
  LoopCloser loop = closer();
  map_.add_keyframe(frame(0, {sighting(3, T_body_tag_)}), body_, {});
  // In view during every third second while the rover passes it over 8 m.
  for (int i = 0; i < 400; i += 30) {
    const auto seen = frame(i, {sighting(3, T_body_tag_)});
    EXPECT_FALSE(loop.sees_loop(*seen, 0.02 * i)) << i;
    loop.record(*seen, body_, 0.02 * i, map_);
  }
}

TEST_F(LoopCloserTest, WhatNoKeyframeSawIsNoLoopYet) {
  LoopCloser loop = closer();
  map_.add_keyframe(frame(0, {}), body_, {});
  loop.record(*frame(1, {sighting(3, T_body_tag_)}), body_, 0, map_);  // a frame between keyframes
  EXPECT_FALSE(loop.sees_loop(*frame(100, {sighting(3, T_body_tag_)}), 5));
  const auto keyframe = frame(100, {sighting(3, T_body_tag_)});
  map_.add_keyframe(keyframe, body_, {});
  loop.record(*keyframe, body_, 5, map_);
  loop.record(*frame(101, {sighting(3, T_body_tag_)}), body_, 5, map_);
  EXPECT_TRUE(loop.sees_loop(*frame(200, {sighting(3, T_body_tag_)}), 10));
}

TEST_F(LoopCloserTest, CanBeSwitchedOff) {
  settings_.loop.enabled = false;
  LoopCloser loop = closer();
  const auto first = frame(0, {sighting(3, T_body_tag_)});
  map_.add_keyframe(first, body_, {});
  loop.record(*first, body_, 0, map_);
  EXPECT_FALSE(loop.sees_loop(*frame(100, {sighting(3, T_body_tag_)}), 5));
}

/// Twenty keyframes of a swinging body with an inertial unit, of which the first sees a registered
/// tag: by that, gravity does not point down in the map.
class LevelTest : public LoopCloserTest {
 protected:
  static constexpr double kLean = 0.2 * std::numbers::pi / 180;

  LevelTest() {
    settings_.inertial = InertialConfig{};
    settings_.inertial->accelerometer.bias = 1e-3;  // m/s^2: gravity is known to 0.006 degrees
    settings_.loop.corner_sigma = 1;                // px
    for (int k = 0; k < 20; ++k) {
      const TagSighting seen = with_corners(sighting(0, T_body_tag_));
      map_.add_keyframe(frame(k, k == 0 ? std::vector{seen} : std::vector<TagSighting>{}),
                        SwingingBody::pose(0.3 * k), {});
      if (k > 0) map_.keyframe(k).motion = swinging_.motion(0.3 * (k - 1), 0.3 * k);
    }
    // The world's vertical lies beside where gravity is in the map.
    const Eigen::Vector3d down = swinging_.gravity.normalized();
    const Pose T_map_world{Eigen::Quaterniond(Eigen::AngleAxisd(kLean, down.unitOrthogonal())) *
                               Eigen::Quaterniond::FromTwoVectors(-Eigen::Vector3d::UnitZ(), down),
                           {1, 2, 3}};
    const Pose T_map_tag = SwingingBody::pose(0) * T_body_tag_;
    down_ = T_map_world.rotation * -Eigen::Vector3d::UnitZ();
    tag_ = {"tag36h11", 0, 0.161, T_map_world.inverse() * T_map_tag};
    map_.tags().push_back({"tag36h11", 0, 0.161, T_map_tag, true});
  }

  /// rad
  double lean() const {
    const Eigen::Vector3d gravity = fit_gravity(map_, InertialConfig{})->gravity;
    return std::asin(gravity.normalized().cross(down_).norm());
  }

  void level() {
    LoopCloser loop = closer({tag_});
    loop.gates().take_over(map_);
    loop.level(map_);
  }

  SwingingBody swinging_;
  Eigen::Vector3d down_;
  RegisteredTag tag_;
};

// Corners of a pixel know the tag's turn to 0.2 degrees or worse, about each axis: so much is
// nothing strange, and gravity is surer.
TEST_F(LevelTest, AMapThatLeansOnATagIsTurnedUpright) {
  const Pose before = map_.keyframe(0).T_map_body;
  const Eigen::Vector3d tag = map_.tags()[0].T_map_tag.translation;
  EXPECT_NEAR(lean(), kLean, 1e-4);
  level();
  EXPECT_LT(lean(), kLean / 4);
  // About the tag: what is seen of its place stays.
  const Pose after = map_.keyframe(0).T_map_body;
  EXPECT_LT((before.inverse() * tag - after.inverse() * tag).norm(), 1e-12);
  ASSERT_TRUE(map_.gravity());
  EXPECT_TRUE(map_.gravity()->by_world);
  EXPECT_LT((map_.gravity()->gravity - kStandardGravity * down_).norm(), 1e-12);
}

TEST_F(LevelTest, WithoutAnInertialUnitItStaysAsItIs) {
  settings_.inertial.reset();
  const Pose before = map_.keyframe(9).T_map_body;
  level();
  EXPECT_EQ(map_.keyframe(9).T_map_body.translation, before.translation);
  EXPECT_FALSE(map_.gravity());
}

TEST_F(LevelTest, TwoRegisteredTagsSayThemselvesHowItLies) {
  map_.tags().push_back({"tag36h11", 1, 0.161, Pose{}, true});
  const Pose before = map_.keyframe(9).T_map_body;
  level();
  EXPECT_EQ(map_.keyframe(9).T_map_body.translation, before.translation);
}

// Fifteen degrees are no error of a sighting: the world's z axis is not the vertical.
TEST_F(LevelTest, AWorldThatIsNotUprightIsLeft) {
  const double degrees = std::numbers::pi / 180;
  tag_.T_world_tag.rotation = exp_so3({15 * degrees, 0, 0}) * tag_.T_world_tag.rotation;
  const Pose before = map_.keyframe(9).T_map_body;
  level();
  EXPECT_EQ(map_.keyframe(9).T_map_body.translation, before.translation);
}

/// Six keyframes along the aisle; the tag's last sighting is beside its first.
class LoopClosureTest : public LoopCloserTest {
 protected:
  LoopClosureTest() : known_(aisle_, {}) {
    for (int k = 0; k < 6; ++k) {
      truth_.push_back({exp_so3({0, 0, 0.02 * k}), {0.08 * k, 0.01 * k, 0}});
    }
  }

  /// Keyframe k at frame 30 k, with the tag in view of the first and the last, and `second`
  /// in view of the last two.
  std::shared_ptr<const FrameFeatures> keyframe(int k, bool second) const {
    const auto i = static_cast<std::size_t>(k);
    const bool sees = k == 0 || k == 5;
    auto features = std::make_shared<FrameFeatures>(
        *(sees ? aisle_.frame_with_tag(30 * k, truth_[i], T_world_tag_)
               : aisle_.frame(30 * k, truth_[i])));
    if (second && k >= 4) {
      TagSighting other = sighting(1, truth_[i].inverse() * truth_[4] * T_body_tag_);
      features->tags.insert(features->tags.begin(), with_corners(other));
    }
    return features;
  }

  /// Every keyframe drifts by 1 cm and 0.3 degrees more than the previous one.
  Pose drifted(int k) const {
    const auto i = static_cast<std::size_t>(k);
    return truth_[i] * Pose{exp_so3({0, 0, 0.005 * k}), {0.01 * k, 0, 0}};
  }

  LoopClosure drive_and_close(LoopCloser& loop, bool second) {
    for (int k = 0; k < 6; ++k) {
      const auto features = keyframe(k, second);
      EXPECT_EQ(loop.sees_loop(*features, 0.5 * k), k == 5) << k;
      const int id = known_.add(features, drifted(k));
      if (k == 5) return loop.close(id, 0.5 * k, known_.rig, known_.map);
      loop.record(*features, drifted(k), 0.5 * k, known_.map);
    }
    return {};
  }

  void expect_true_poses() const {
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_LT(distance(known_.map.keyframes()[k].T_map_body, truth_[k]), 1e-5) << k;
      EXPECT_LT(angle(known_.map.keyframes()[k].T_map_body, truth_[k]), 1e-5) << k;
    }
  }

  const Pose T_world_tag_ = Pose{exp_so3({-1.5, 0.1, 0}), {0.25, -0.8, 0.5}};
  std::vector<Pose> truth_;
  AisleMap known_;
};

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
