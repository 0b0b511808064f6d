// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "sim/tag_family.h"
#include "tests/sim/test_folder.h"

namespace vinebench {
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
  expect_points(post_positions(world), {{1, 2}, {1, 4}, {1, 6}, {1, 7}});
}

TEST(PostPositionsTest, AVeryShortLastSpanIsMergedWithItsNeighbour) {
  WorldConfig world = one_row({0, 0}, {4.3, 0});
  world.trellis.post_spacing = 2;
  expect_points(post_positions(world), {{0, 0}, {2, 0}, {4.3, 0}});
}

TEST(PostPositionsTest, ARowShorterThanASpanHasItsTwoEnds) {
  WorldConfig world = one_row({0, 0}, {0.3, 0});
  world.trellis.post_spacing = 2;
  expect_points(post_positions(world), {{0, 0}, {0.3, 0}});
}

TEST(VinePositionsTest, StandHalfASpacingFromEitherEndRowByRow) {
  WorldConfig world = one_row({0, 0}, {3, 0});
  world.rows.push_back({{0, 1}, {0, 3}});
  world.vines.spacing = 1;
  expect_points(vine_positions(world), {{0.5, 0}, {1.5, 0}, {2.5, 0}, {0, 1.5}, {0, 2.5}});
}

TEST(VinePositionsTest, ALeftoverOfTheRowStaysEmpty) {
  WorldConfig world = one_row({0, 0}, {0, 2.6});
  world.vines.spacing = 1;
  // Next would be 2.5 m, nearer than half a spacing to the end.
  expect_points(vine_positions(world), {{0, 0.5}, {0, 1.5}});
}

TEST(TagPoseTest, ThePrintFacesItsHeadingAndStandsUpright) {
  WorldConfig::Tag tag;
  tag.position = {0.06, -0.36, 0.5};
  tag.facing_deg = 90;  // north
  const Pose pose = tag_pose(tag);
  EXPECT_EQ(pose.translation, tag.position);
  // Who reads a print that faces north looks south: right is west, down is down.
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitY() - Eigen::Vector3d(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d(0, -1, 0)).norm(), 1e-12);
}

TEST(TagPoseTest, AnyHeadingGivesARotation) {
  for (int degrees = -360; degrees <= 360; degrees += 15) {
    WorldConfig::Tag tag;
    tag.facing_deg = degrees;
    const double heading = degrees * std::numbers::pi / 180;
    const Eigen::Vector3d out = tag_pose(tag).rotation * -Eigen::Vector3d::UnitZ();
    EXPECT_LT((out - Eigen::Vector3d(std::cos(heading), std::sin(heading), 0)).norm(), 1e-12);
    EXPECT_NEAR(tag_pose(tag).rotation.norm(), 1, 1e-12);
  }
}

TEST(BoxPoseTest, TheBoxStandsOnTheGroundTurnedByItsYaw) {
  WorldConfig::Box box;
  box.size = {0.5, 1.2, 0.8};
  box.position = {5, 0.3};
  box.yaw_deg = 90;
  const Pose pose = box_pose(box);
  EXPECT_LT((pose.translation - Eigen::Vector3d(5, 0.3, 0.4)).norm(), 1e-12);
  EXPECT_LT((pose.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

TEST(RegisteredTagsTest, AreThoseThatTheWorldRegisters) {
  WorldConfig world = one_row({0, 0}, {4, 0});
  world.tags.resize(3);
  for (int i = 0; i < 3; ++i) world.tags[static_cast<std::size_t>(i)].id = 10 + i;
  world.tags[1].registered = false;
  world.tags[2].size = 0.3;
  world.tags[2].position = {1, 2, 3};
  const std::vector<RegisteredTag> tags = registered_tags(world);
  ASSERT_EQ(tags.size(), 2u);
  EXPECT_EQ(tags[0].id, 10);
  EXPECT_EQ(tags[1].id, 12);
  EXPECT_EQ(tags[1].family, "tag36h11");
  EXPECT_EQ(tags[1].size, 0.3);
  EXPECT_EQ(tags[1].T_world_tag.translation, Eigen::Vector3d(1, 2, 3));
}

TEST(TagProblemTest, KnowsEveryFamilyAndItsLastTag) {
  // The library's own counts, as its documentation has them.
  EXPECT_EQ(TagFamily("tag36h11").size(), 587);
  EXPECT_EQ(TagFamily("tag16h5").size(), 30);
  EXPECT_EQ(TagFamily("tag25h9").size(), 35);
  for (const std::string& family : TagFamily::names()) {
    EXPECT_EQ(WorldConfig::tag_problem(family, 0), "");
    EXPECT_EQ(WorldConfig::tag_problem(family, TagFamily(family).size() - 1), "");
    EXPECT_NE(WorldConfig::tag_problem(family, TagFamily(family).size()), "");
    EXPECT_NE(WorldConfig::tag_problem(family, -1), "");
  }
}

TEST(TagProblemTest, SaysWhatWasExpected) {
  EXPECT_EQ(WorldConfig::tag_problem("tag36h11", 587), "expected 0 to 586 for tag36h11, found 587");
  EXPECT_THAT(WorldConfig::tag_problem("tag37h11", 0),
              AllOf(HasSubstr("expected a family of tag16h5, "), HasSubstr("found tag37h11")));
}

std::string error_of_world(const std::string& text) {
  const test::TestFolder folder;
  const auto file = folder.write("world.yaml", text);
  return test::error_of([&] { YamlDocument::load(file).read<WorldConfig>(); });
}

TEST(WorldFileTest, TheShippedVineyardIsThatOfThePaper) {
  const auto file = std::filesystem::path(VINEBENCH_SOURCE_DIR) / "worlds" / "csl-vineyard.yaml";
  const WorldConfig world = YamlDocument::load(file).read<WorldConfig>();
  EXPECT_EQ(world.name, "csl-vineyard");
  ASSERT_EQ(world.rows.size(), 3u);
  for (const WorldConfig::Row& row : world.rows) EXPECT_EQ((row.end - row.start).norm(), 4);
  EXPECT_EQ(vine_positions(world).size(), 12u);  // 4 of each row, 1 m apart
  EXPECT_EQ(post_positions(world).size(), 9u);   // 3 of each row, 2 m apart
  EXPECT_EQ(world.vines.lowest_bunch, 0.60);
  ASSERT_EQ(world.tags.size(), 1u);
  EXPECT_EQ(world.tags[0].family, "tag36h11");
  EXPECT_EQ(world.tags[0].id, 0);
  EXPECT_EQ(world.tags[0].size, 0.161);
  EXPECT_NO_THROW(validate(world));
}

TEST(WorldFileTest, ProblemsAreNamed) {
  const std::string row = "rows:\n  - {start: [0, 0], end: [4, 0]}\n";
  EXPECT_EQ(error_of_world(row), "");
  EXPECT_THAT(error_of_world("name: bare\n"), HasSubstr("rows: expected at least one row"));
  EXPECT_THAT(error_of_world("rows:\n  - {start: [1, 0], end: [1, 0]}\n"),
              HasSubstr("expected a row of at least 0.1 m"));
  EXPECT_THAT(error_of_world(row + "tags: [{id: 587}]\n"),
              AllOf(HasSubstr("world.yaml:3"), HasSubstr("tags.0.id"),
                    HasSubstr("expected 0 to 586 for tag36h11, found 587")));
  EXPECT_THAT(error_of_world(row + "tags: [{family: tag1, id: 0}]\n"), HasSubstr("found tag1"));
  EXPECT_THAT(error_of_world(row + "vines: {spacing: -1}\n"), HasSubstr("vines.spacing"));
  EXPECT_THAT(error_of_world(row + "vines: {canopy_top: 0.5}\n"),
              HasSubstr("more than lowest_bunch"));
  EXPECT_THAT(error_of_world(row + "vines: {meshes: [nowhere.glb]}\n"),
              AllOf(HasSubstr("vines.meshes.0"), HasSubstr("nowhere.glb")));
}

}  // namespace
}  // namespace vinebench
