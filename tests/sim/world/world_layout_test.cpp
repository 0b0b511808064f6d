// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/world_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/config/yaml_writer.h"
#include "sim/world/occluder_pose.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;

WorldConfig one_row(const Eigen::Vector2d& start, const Eigen::Vector2d& end) {
  WorldConfig world;
  world.rows.push_back({start, end});
  return world;
}

void expect_points(const std::vector<Eigen::Vector2d>& found,
                   const std::vector<Eigen::Vector2d>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i] - expected[i]).norm(), 1e-9) << i << ": " << found[i].transpose();
  }
}

TEST(PostPositionsTest, OneStandsAtEitherEndAndEverySpacingBetween) {
  WorldConfig world = one_row({1, 2}, {1, 7});
  world.trellis.post_spacing = 2;
  // The last whole span ends 1 m before the row's end: half a span, so it keeps its post.
  expect_points(lay_out(world).post_feet(), {{1, 2}, {1, 4}, {1, 6}, {1, 7}});
}

TEST(PostPositionsTest, AVeryShortLastSpanIsMergedWithItsNeighbour) {
  WorldConfig world = one_row({0, 0}, {4.3, 0});
  world.trellis.post_spacing = 2;
  expect_points(lay_out(world).post_feet(), {{0, 0}, {2, 0}, {4.3, 0}});
}

TEST(PostPositionsTest, ARowShorterThanASpanHasItsTwoEnds) {
  WorldConfig world = one_row({0, 0}, {0.3, 0});
  world.trellis.post_spacing = 2;
  expect_points(lay_out(world).post_feet(), {{0, 0}, {0.3, 0}});
}

TEST(VinePositionsTest, StandHalfASpacingFromEitherEndRowByRow) {
  WorldConfig world = one_row({0, 0}, {3, 0});
  world.rows.push_back({{0, 1}, {0, 3}});
  world.vines.spacing = 1;
  expect_points(lay_out(world).vine_feet(), {{0.5, 0}, {1.5, 0}, {2.5, 0}, {0, 1.5}, {0, 2.5}});
}

TEST(VinePositionsTest, ALeftoverOfTheRowStaysEmpty) {
  WorldConfig world = one_row({0, 0}, {0, 2.6});
  world.vines.spacing = 1;
  // Next would be 2.5 m, nearer than half a spacing to the end.
  expect_points(lay_out(world).vine_feet(), {{0, 0.5}, {0, 1.5}});
}

TEST(TagPoseTest, ThePrintFacesItsHeadingAndStandsUpright) {
  TagPlace tag;
  tag.position = {0.06, -0.36, 0.5};
  tag.facing_deg = 90;  // north
  const Pose pose = tag_pose(tag);
  EXPECT_EQ(pose.translation, tag.position);
  // The viewer of a print that faces north looks south: right is west, down is down.
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitY() - Eigen::Vector3d(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d(0, -1, 0)).norm(), 1e-12);
}

TEST(TagPoseTest, AnyHeadingGivesARotation) {
  for (int degrees = -360; degrees <= 360; degrees += 15) {
    TagPlace tag;
    tag.facing_deg = degrees;
    const double heading = degrees * std::numbers::pi / 180;
    const Eigen::Vector3d out = tag_pose(tag).rotation * -Eigen::Vector3d::UnitZ();
    EXPECT_LT((out - Eigen::Vector3d(std::cos(heading), std::sin(heading), 0)).norm(), 1e-12);
    EXPECT_NEAR(tag_pose(tag).rotation.norm(), 1, 1e-12);
  }
}

TEST(RegisteredTagsTest, AreThoseThatTheWorldRegisters) {
  WorldConfig world = one_row({0, 0}, {4, 0});
  world.tags.resize(3);
  for (int i = 0; i < 3; ++i) world.tags[static_cast<std::size_t>(i)].id = 10 + i;
  world.tags[1].registered = false;
  world.tags[2].size = 0.3;
  world.tags[2].position = {1, 2, 3};
  const std::vector<RegisteredTag> tags = registered_tags(world, 1);
  ASSERT_EQ(tags.size(), 2u);
  EXPECT_EQ(tags[0].id, 10);
  EXPECT_EQ(tags[1].id, 12);
  EXPECT_EQ(tags[1].family, "tag36h11");
  EXPECT_EQ(tags[1].size, 0.3);
  EXPECT_EQ(tags[1].T_world_tag.translation, Eigen::Vector3d(1, 2, 3));
}

// The tag faces along x; with a survey error of 90 degrees to the left it seems to face along y:
// the z axis, into the tag, is then -y.
TEST(RegisteredTagsTest, CarryTheErrorOfTheirSurvey) {
  WorldConfig world = one_row({0, 0}, {4, 0});
  world.tags.resize(1);
  world.tags[0].position = {1, 2, 0.5};
  world.tags[0].survey_error = {{0.01, -0.02, 0.03}, 90};
  const RegisteredTag told = registered_tags(world, 1).at(0);
  EXPECT_LT((told.T_world_tag.translation - Eigen::Vector3d(1.01, 1.98, 0.53)).norm(), 1e-12);
  const Eigen::Vector3d into = told.T_world_tag.rotation * Eigen::Vector3d::UnitZ();
  EXPECT_LT((into + Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_EQ(tag_pose(lay_out(world).tags[0]).translation,
            Eigen::Vector3d(1, 2, 0.5));  // the true pose
}

// 4,000 draws of a deviation s have one of s within 1.1 % (one standard deviation): 5 % is safe.
TEST(RegisteredTagsTest, CarryWhatTheSeedDrawsOfTheSurvey) {
  WorldConfig world = one_row({0, 0}, {4, 0});
  world.tags.resize(4000);
  world.survey = {0.01, 0.5};
  const std::vector<RegisteredTag> tags = registered_tags(world, 7);
  double square = 0;
  double turn = 0;
  for (const RegisteredTag& tag : tags) {
    const Pose off = tag_pose(lay_out(world).tags[0]).inverse() * tag.T_world_tag;
    square += off.translation.squaredNorm() / 3;
    turn += log_so3(off.rotation).squaredNorm() / 3;
  }
  EXPECT_NEAR(std::sqrt(square / 4000), 0.01, 0.0005);
  EXPECT_NEAR(std::sqrt(turn / 4000), 0.5 * std::numbers::pi / 180, 0.05 * 0.5 * 0.0175);
  EXPECT_EQ(tags[0].survey.position, 0.01);
  EXPECT_NEAR(tags[0].survey.rotation, 0.5 * std::numbers::pi / 180, 1e-15);
  // Each seed has its own; the true tags stay where they are.
  EXPECT_EQ(registered_tags(world, 7)[3].T_world_tag.translation, tags[3].T_world_tag.translation);
  EXPECT_NE(registered_tags(world, 8)[3].T_world_tag.translation, tags[3].T_world_tag.translation);
  EXPECT_EQ(world_tags(world)[3].T_world_tag.translation,
            tag_pose(lay_out(world).tags[3]).translation);
}

TEST(BlockTest, BecomesRowsSideBySide) {
  WorldConfig world;
  world.block = WorldConfig::Block{3, 10, 2, 90, {1, 2}};
  world.rows = {{{5, 0}, {5, 12}}};
  const std::vector<RowConfig> rows = lay_out(world).rows;
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].start, Eigen::Vector2d(5, 0));  // those of the file come first
  // Along y, each row 2 m to the left of the previous one, towards -x.
  for (int i = 0; i < 3; ++i) {
    const RowConfig& row = rows[static_cast<std::size_t>(i) + 1];
    EXPECT_LT((row.start - Eigen::Vector2d(1 - 2 * i, 2)).norm(), 1e-12);
    EXPECT_LT((row.end - Eigen::Vector2d(1 - 2 * i, 12)).norm(), 1e-12);
  }
}

TEST(TrellisPostTest, EndPostsLeanOutward) {
  WorldConfig world = one_row({0, 0}, {6, 0});
  world.trellis.end_lean_deg = 45;
  world.trellis.post_radius = 0.03;
  world.trellis.end_post_radius = 0.06;
  const std::vector<TrellisPost> posts = lay_out(world).posts;
  ASSERT_EQ(posts.size(), 4u);
  EXPECT_LT((posts[0].at(1) - Eigen::Vector2d(-1, 0)).norm(), 1e-12);
  EXPECT_LT((posts[1].at(1) - Eigen::Vector2d(2, 0)).norm(), 1e-12);
  EXPECT_LT((posts[3].at(1) - Eigen::Vector2d(7, 0)).norm(), 1e-12);
  EXPECT_EQ(posts[0].radius, 0.06);
  EXPECT_EQ(posts[1].radius, 0.03);
}

TEST(TagOnPostTest, HangsOnTheSideThatIsNamed) {
  using Side = WorldConfig::PostSide::Side;
  WorldConfig world = one_row({0, 0}, {0, 6});
  world.trellis.end_lean_deg = 0;
  world.trellis.end_post_radius = 0.05;
  world.tags.resize(2);
  world.tags[0].post = WorldConfig::PostSide{0, -1, Side::kLeft, 0.7};
  world.tags[1].post = WorldConfig::PostSide{0, 1, Side::kStart, 0.4};
  // The row runs north, so its left is west; 5 cm of post and 5 mm of board are below the print.
  const Pose left = tag_pose(lay_out(world).tags[0]);
  EXPECT_LT((left.translation - Eigen::Vector3d(-0.055, 6, 0.7)).norm(), 1e-9);
  EXPECT_LT((left.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-9);
  const Pose start = tag_pose(lay_out(world).tags[1]);
  EXPECT_LT((start.translation - Eigen::Vector3d(0, 2 - 0.035 - 0.005, 0.4)).norm(), 1e-9);
  EXPECT_LT((start.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitY()).norm(), 1e-9);
}

TEST(TagOnPostTest, OnALeaningPostItsBoardClearsTheWood) {
  WorldConfig world = one_row({0, 0}, {6, 0});
  world.trellis.end_lean_deg = 20;
  world.tags.resize(1);
  world.tags[0].post = WorldConfig::PostSide{0, 0, WorldConfig::PostSide::Side::kStart, 0.5};
  const double lean = std::tan(20 * std::numbers::pi / 180);
  // At the board's upper edge (half of 1.5 black squares up) the post's face is furthest out.
  const double half = 0.161 * 1.5 / 2;
  const double face = -lean * (0.5 + half) - 0.035 * std::sqrt(1 + lean * lean);
  EXPECT_NEAR(lay_out(world).tags[0].position.x(), face - 0.005, 1e-9);
}

TEST(WorldLayoutTest, ThingsStandOnUnevenGround) {
  WorldConfig world = one_row({0, 0}, {6, 0});
  world.terrain.slope_percent = 10;
  world.terrain.slope_heading_deg = 0;
  world.tags.resize(1);
  world.tags[0].position = {5, 1, 0.5};
  // Height is 0 in the rows' middle, x = 3 m, and rises by 0.1 m a metre.
  EXPECT_NEAR(tag_pose(lay_out(world).tags[0]).translation.z(), 0.2 + 0.5, 1e-9);
}

/// A block beside a row, with a tag on its third row and another of its own.
WorldConfig related() {
  WorldConfig world = one_row({0, 8}, {10, 8});
  world.block = WorldConfig::Block{3, 10, 2, 0, {0, 0}};
  world.terrain.slope_percent = 5;
  world.tags.resize(2);
  world.tags[0].post = WorldConfig::PostSide{3, 1, WorldConfig::PostSide::Side::kRight, 0.5};
  world.tags[1].position = {3, 1, 0.4};
  world.occluders.resize(1);
  world.occluders[0].position = {4, 1};
  return world;
}

TEST(WorldLayoutTest, LeavesTheConfigurationAsItIs) {
  const WorldConfig world = related();
  const std::string before = format_yaml(world);
  lay_out(world);
  EXPECT_EQ(format_yaml(world), before);
  EXPECT_THAT(before, HasSubstr("block:"));
}

TEST(WorldLayoutTest, AWorldThatIsWrittenOutHasTheSameLayout) {
  const WorldConfig world = related(), out = written_out(world);
  EXPECT_FALSE(out.block);
  EXPECT_EQ(out.rows.size(), 4u);
  // Post 1 of a row 4 m to the left of the x axis stands at (2, 4); its right side faces south.
  EXPECT_NEAR(out.tags[0].position.x(), 2, 1e-9);
  EXPECT_LT(out.tags[0].position.y(), 4);
  EXPECT_NEAR(out.tags[0].facing_deg, -90, 1e-9);
  const WorldLayout a = lay_out(world), b = lay_out(out);
  ASSERT_EQ(a.posts.size(), b.posts.size());
  EXPECT_EQ(a.posts.back().foot, b.posts.back().foot);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(tag_pose(a.tags[i]).translation, tag_pose(b.tags[i]).translation);
    EXPECT_EQ(tag_pose(a.tags[i]).rotation.coeffs(), tag_pose(b.tags[i]).rotation.coeffs());
  }
  EXPECT_EQ(format_yaml(written_out(out)), format_yaml(out));
}

TEST(WorldLayoutTest, OccludersStandOnTheGround) {
  const WorldConfig world = related();
  const WorldLayout layout = lay_out(world);
  const Pose expected = occluder_pose(world.occluders[0], layout.terrain);
  EXPECT_EQ(layout.occluders.at(0).translation, expected.translation);
  EXPECT_NE(expected.translation.z(), 0);
}

TEST(WorldLayoutTest, ATagOnAPostThatIsNotThereIsAnError) {
  WorldConfig world = related();
  world.tags[0].post->row = 4;
  EXPECT_THAT(test::error_of([&] { lay_out(world); }),
              HasSubstr("tags.0.post: expected a row from 0 to 3, found 4"));
  world.tags[0].post->row = 0;
  world.tags[0].post->index = 6;  // posts at 0, 2, ... 10 m
  EXPECT_THAT(test::error_of([&] { lay_out(world); }),
              HasSubstr("expected an index from -6 to 5 in row 0, found 6"));
}

TEST(SiteTest, IsTheLayoutSeenFromAbove) {
  const WorldConfig world = related();
  const Site site = site_of(world);
  EXPECT_EQ(site.rows.size(), 4u);
  EXPECT_EQ(site.vines.size(), 40u);  // 10 of each row, 1 m apart
  EXPECT_EQ(site.posts.size(), 24u);  // 6 of each row
  ASSERT_EQ(site.tags.size(), 2u);
  EXPECT_EQ(site.tags[0].T_world_tag.translation, tag_pose(lay_out(world).tags[0]).translation);
  EXPECT_EQ(site.objects.at(0).centre, Eigen::Vector2d(4, 1));
  EXPECT_FALSE(site.objects.at(0).moves);
}

}  // namespace
}  // namespace vinebench::sim
