// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/loop_closer.h"

#include <gtest/gtest.h>

#include <numbers>

#include "slam/optimisation/gravity_fit.h"
#include "tests/support/loop_closer_case.h"
#include "tests/support/swinging_body.h"

namespace vinebench::slam {
namespace {

using test::angle;
using test::distance;
using test::SwingingBody;
using test_case::LoopCloserTest;

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

// The distance of a tag that is eight times as far away is known 64 times worse, and its turn eight
// times: 0.1 mm and 0.05 degrees or so are beyond 3 mm and 0.2 degrees then.
TEST_F(LoopCloserTest, ATagFirstSeenFromAfarIsNotSurelyPlaced) {
  const Pose near{exp_so3({-1.5, 0.4, 0.1}), {0.1, -1.0, 0.5}};
  const Pose far{near.rotation, {0.1, -8.0, 0.5}};
  LoopCloser loop = closer();
  loop.record(*frame(0, {with_corners(sighting(1, near)), with_corners(sighting(2, far))}), body_,
              0, map_);
  ASSERT_EQ(map_.tags().size(), 2u);
  EXPECT_TRUE(map_.find_tag("tag36h11", 1)->sure);
  EXPECT_FALSE(map_.find_tag("tag36h11", 2)->sure);
}

// Registered ones stand in the world, whose place in the map is as sure as the tag that told it.
TEST_F(LoopCloserTest, RegisteredTagsAreAsSurelyPlacedAsTheWorld) {
  const Pose near{exp_so3({-1.5, 0.4, 0.1}), {0.1, -1.0, 0.5}};
  const Pose far{near.rotation, {0.1, -8.0, 0.5}};
  const Pose T_world_body = body_;
  const std::vector<RegisteredTag> tags{{"tag36h11", 1, 0.161, T_world_body * near},
                                        {"tag36h11", 2, 0.161, T_world_body * far}};
  for (const bool near_first : {true, false}) {
    map_.tags().clear();
    map_.world().reset();
    LoopCloser loop = closer(tags);
    const TagSighting one = with_corners(sighting(1, near)), two = with_corners(sighting(2, far));
    loop.record(*frame(0, {near_first ? one : two}), body_, 0, map_);
    loop.record(*frame(1, {near_first ? two : one}), body_, 0, map_);
    ASSERT_EQ(map_.tags().size(), 2u);
    for (const MapTag& tag : map_.tags()) EXPECT_EQ(tag.sure, near_first) << tag.id;
  }
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
    settings_.inertial = InertialNoise{};
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
    const Eigen::Vector3d gravity = fit_gravity(map_, InertialNoise{})->gravity;
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

}  // namespace
}  // namespace vinebench::slam
