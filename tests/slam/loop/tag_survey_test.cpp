// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/loop/tag_survey.h"

#include <gtest/gtest.h>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::angle;
using test::distance;

const Pose kWorld{exp_so3({0.1, -0.2, 0.7}), {3, -1, 0.4}};  // T_map_world

Pose place(double x, double y) {
  return {exp_so3({-1.5, 0.1 * x, 0.2 * y}), {x, y, 0.5}};
}

FoundTag found(const Pose& T_world_tag, const Vector6d& off, double sigma) {
  return {T_world_tag, kWorld * T_world_tag * step_of(off), sigma * sigma * Matrix6d::Identity()};
}

TEST(TagSurveyTest, TagsThatSayNothingHaveTheOtherAccuracy) {
  std::vector<RegisteredTag> tags(2);
  tags[1].survey = {0.02, 0.03};
  tags = with_accuracy(tags, {0.01, 0.005});
  EXPECT_EQ(tags[0].survey.position, 0.01);
  EXPECT_EQ(tags[0].survey.rotation, 0.005);
  EXPECT_EQ(tags[1].survey.position, 0.02);
  EXPECT_FALSE(is_exact(tags[0].survey));
  EXPECT_TRUE(is_exact({}));
  const Matrix6d covariance = survey_covariance(tags[1].survey);
  EXPECT_DOUBLE_EQ(covariance(2, 2), 4e-4);
  EXPECT_DOUBLE_EQ(covariance(3, 3), 9e-4);
}

TEST(TagSurveyTest, AMisplacementIsTheStepFromTheSurveyToTheTag) {
  Vector6d off;
  off << 0.01, -0.02, 0.03, 0.1, -0.05, 0.02;
  EXPECT_LT((misplacement(found(place(4, 1), off, 1), kWorld) - off).norm(), 1e-12);
}

TEST(TagSurveyTest, TheWorldIsRecoveredFromExactTags) {
  const Vector6d none = Vector6d::Zero();
  for (const auto& tags : {std::vector{found(place(4, 1), none, 1)},
                           {found(place(4, 1), none, 1), found(place(-2, 5), none, 0.1),
                            found(place(0, 0), none, 3)}}) {
    const Pose world = likeliest_world(tags);
    EXPECT_LT(distance(world, kWorld), 1e-12);
    EXPECT_LT(angle(world, kWorld), 1e-7);  // acos near 1
  }
}

// Both tags are 3 cm off along the world's x, one as much to either side: the likeliest world is
// off by their mean weighted by 1/sigma^2, (4 x 3 - 1 x 3) / 5 = 1.8 cm. What the tags' axes are
// does not matter, so they are the world's.
TEST(TagSurveyTest, TheSurerTagCountsForMore) {
  Vector6d ahead = Vector6d::Zero();
  ahead.x() = 0.03;
  const Pose a{Eigen::Quaterniond::Identity(), {0, 2, 0}};
  const Pose b{Eigen::Quaterniond::Identity(), {0, -2, 0}};
  // Turns are known so well that the difference does not become one.
  FoundTag surer = found(a, ahead, 0.01);
  FoundTag other = found(b, -ahead, 0.02);
  surer.covariance.bottomRightCorner<3, 3>() = 1e-16 * Eigen::Matrix3d::Identity();
  other.covariance.bottomRightCorner<3, 3>() = 1e-16 * Eigen::Matrix3d::Identity();
  const Pose off = kWorld.inverse() * likeliest_world({surer, other});
  EXPECT_NEAR(off.translation.x(), 0.018, 1e-6);
  EXPECT_LT(off.translation.tail<2>().norm(), 1e-6);
}

MapTag surveyed(int id, const FoundTag& tag) {
  MapTag made{"tag36h11", id, 0.161, tag.T_map_tag};
  made.survey = SurveyedPlace{tag.T_world_tag, tag.covariance};
  return made;
}

TEST(TagSurveyTest, AllSurveyedTagsOfAMapSayWhereTheWorldIs) {
  Map map(1.2);
  EXPECT_FALSE(world_by_tags(map));
  map.world() = Pose{Eigen::Quaterniond::Identity(), {7, 8, 9}};
  Vector6d off = Vector6d::Zero();
  off.y() = 0.02;
  const FoundTag first = found(place(4, 1), off, 0.01);
  const FoundTag second = found(place(-2, 5), -off, 0.02);
  map.tags() = {surveyed(0, first), MapTag{"tag36h11", 5, 0.161, {}}};
  EXPECT_EQ(world_by_tags(map)->translation, map.world()->translation);  // one says no more
  map.tags().push_back(surveyed(1, second));
  EXPECT_EQ(world_by_tags(map)->translation, likeliest_world({first, second}).translation);
  map.tags().push_back({"tag36h11", 2, 0.161, {}, true});
  EXPECT_EQ(world_by_tags(map)->translation, map.world()->translation);  // one is exact
}

}  // namespace
}  // namespace vinebench::slam
