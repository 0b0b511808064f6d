// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/config/validate.h"
#include "core/config/yaml_writer.h"
#include "sim/config_files.h"
#include "sim/world/row_frame.h"
#include "sim/world/tag_family.h"
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
  // The viewer of a print that faces north looks south: right is west, down is down.
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

// The tag faces along x; with a survey error of 90 degrees to the left it seems to face along y:
// the z axis, into the tag, is then -y.
TEST(RegisteredTagsTest, CarryTheErrorOfTheirSurvey) {
  WorldConfig world = one_row({0, 0}, {4, 0});
  world.tags.resize(1);
  world.tags[0].position = {1, 2, 0.5};
  world.tags[0].survey_error = {{0.01, -0.02, 0.03}, 90};
  const RegisteredTag told = registered_tags(world).at(0);
  EXPECT_LT((told.T_world_tag.translation - Eigen::Vector3d(1.01, 1.98, 0.53)).norm(), 1e-12);
  const Eigen::Vector3d into = told.T_world_tag.rotation * Eigen::Vector3d::UnitZ();
  EXPECT_LT((into + Eigen::Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_EQ(tag_pose(world.tags[0]).translation, Eigen::Vector3d(1, 2, 0.5));  // the true pose
}

TEST(TagProblemTest, KnowsEveryFamilyAndItsLastTag) {
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
  return test::error_of([&] { load_world(file); });
}

TEST(WorldFileTest, TheShippedVineyardIsThatOfThePaper) {
  const auto file = std::filesystem::path(VINEBENCH_SOURCE_DIR) / "worlds" / "csl-vineyard.yaml";
  const WorldConfig world = load_world(file);
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

TEST(BlockTest, BecomesRowsSideBySide) {
  WorldConfig world;
  world.block = WorldConfig::Block{3, 10, 2, 90, {1, 2}};
  world.place();
  EXPECT_FALSE(world.block);
  ASSERT_EQ(world.rows.size(), 3u);
  // Along y, each row 2 m to the left of the previous one, towards -x.
  for (int i = 0; i < 3; ++i) {
    const WorldConfig::Row& row = world.rows[static_cast<std::size_t>(i)];
    EXPECT_LT((row.start - Eigen::Vector2d(1 - 2 * i, 2)).norm(), 1e-12);
    EXPECT_LT((row.end - Eigen::Vector2d(1 - 2 * i, 12)).norm(), 1e-12);
  }
  world.place();  // idempotent
  EXPECT_EQ(world.rows.size(), 3u);
}

TEST(TrellisPostTest, EndPostsLeanOutward) {
  WorldConfig world = one_row({0, 0}, {6, 0});
  world.trellis.end_lean_deg = 45;
  world.trellis.post_radius = 0.03;
  world.trellis.end_post_radius = 0.06;
  const std::vector<TrellisPost> posts = trellis_posts(world);
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
  world.place();
  // The row runs north, so its left is west; 5 cm of post and 5 mm of board are below the print.
  const Pose left = tag_pose(world.tags[0]);
  EXPECT_LT((left.translation - Eigen::Vector3d(-0.055, 6, 0.7)).norm(), 1e-9);
  EXPECT_LT((left.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-9);
  const Pose start = tag_pose(world.tags[1]);
  EXPECT_LT((start.translation - Eigen::Vector3d(0, 2 - 0.035 - 0.005, 0.4)).norm(), 1e-9);
  EXPECT_LT((start.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitY()).norm(), 1e-9);
}

TEST(TagOnPostTest, OnALeaningPostItsBoardClearsTheWood) {
  WorldConfig world = one_row({0, 0}, {6, 0});
  world.trellis.end_lean_deg = 20;
  world.tags.resize(1);
  world.tags[0].post = WorldConfig::PostSide{0, 0, WorldConfig::PostSide::Side::kStart, 0.5};
  world.place();
  const double lean = std::tan(20 * std::numbers::pi / 180);
  // At the board's upper edge (half of 1.5 black squares up) the post's face is furthest out.
  const double half = 0.161 * 1.5 / 2;
  const double face = -lean * (0.5 + half) - 0.035 * std::sqrt(1 + lean * lean);
  EXPECT_NEAR(world.tags[0].position.x(), face - 0.005, 1e-9);
}

TEST(PlacingTest, ThingsStandOnUnevenGround) {
  WorldConfig world = one_row({0, 0}, {6, 0});
  world.terrain.slope_percent = 10;
  world.terrain.slope_heading_deg = 0;
  world.tags.resize(1);
  world.tags[0].position = {5, 1, 0.5};
  world.place();
  // Height is 0 in the rows' middle, x = 3 m, and rises by 0.1 m a metre.
  EXPECT_NEAR(tag_pose(world.tags[0]).translation.z(), 0.2 + 0.5, 1e-9);
}

TEST(WorldFileTest, TheShippedWorldsAreWhatTheySay) {
  const auto load = [](const char* name) {
    const auto file = std::filesystem::path(VINEBENCH_SOURCE_DIR) / "worlds" / name;
    return load_world(file);
  };
  const WorldConfig typical = load("typical-vineyard.yaml");
  EXPECT_EQ(typical.rows.size(), 10u);
  EXPECT_GE(vine_positions(typical).size(), 300u);
  EXPECT_EQ(registered_tags(typical).size(), 20u);
  EXPECT_FALSE(typical.terrain.flat());
  EXPECT_TRUE(row_frame(typical.rows).regular);
  EXPECT_NEAR(row_frame(typical.rows).spacing, 2.5, 1e-9);
  const WorldConfig many = load("many-rows.yaml");
  EXPECT_EQ(many.rows.size(), 10u);
  EXPECT_EQ(registered_tags(many).size(), 1u);
  EXPECT_TRUE(many.terrain.flat());
  EXPECT_LE(many.vines.templates, 3);
  // The authors' route changes aisles at x = -0.46 m and 6.95 m (the rover's near side).
  for (const TrellisPost& post : trellis_posts(many)) {
    EXPECT_GT(post.at(0.3).x() - post.radius, -0.46);
    EXPECT_LT(post.at(0.3).x() + post.radius, 6.95);
  }
}

/// Distance from a point to the rover's hull, 0.50 m by 0.472 m, at (x, y, heading).
double distance_to_hull(const Eigen::Vector3d& pose, const Eigen::Vector2d& p) {
  const Eigen::Vector2d local = Eigen::Rotation2Dd(-pose.z()) * (p - pose.head<2>());
  return (local.cwiseAbs() - Eigen::Vector2d(0.25, 0.236)).cwiseMax(0.0).norm();
}

TEST(WorldFileTest, TheAuthorsRouteFitsTheAislesOfManyRows) {
  const auto file = std::filesystem::path(VINEBENCH_SOURCE_DIR) / "worlds" / "many-rows.yaml";
  const WorldConfig world = load_world(file);
  // Places (m) and headings (degrees) of the paper's third simulated experiment.
  const std::vector<Eigen::Vector3d> route{
      {0, 0, 0},           {7.46, 0, 0},        {7.26, 0.09, 94},    {7.12, 1.79, 95},
      {7.03, 1.65, 160},   {6.00, 1.88, 185},   {4.05, 2.01, 174},   {2.12, 1.82, 186},
      {0.61, 1.97, 176},   {-0.82, 1.60, 198},  {-0.70, 1.52, 260},  {-0.70, 1.07, 277},
      {-0.79, -0.79, 267}, {-0.53, -2.28, 281}, {-0.46, -2.11, 366}, {0.92, -2.16, 348},
      {8.45, -2.01, 373},  {8.36, -1.93, 432},  {8.35, -1.53, 457},  {8.40, 4.17, 456},
      {8.32, 4.02, 541},   {4.29, 3.91, 541},   {2.91, 4.02, 534},   {-1.99, 3.62, 554},
      {-1.83, 3.44, 635},  {-1.75, 2.63, 635},  {-1.89, 1.46, 625},  {-1.69, -0.19, 648},
      {-1.54, -0.04, 723}, {0.70, 0.14, 725}};
  double nearest = 1e9;
  for (std::size_t leg = 1; leg < route.size(); ++leg) {
    for (double t = 0; t <= 1; t += 0.01) {
      Eigen::Vector3d pose = route[leg - 1] + t * (route[leg] - route[leg - 1]);
      pose.z() *= std::numbers::pi / 180;
      for (const TrellisPost& post : trellis_posts(world)) {
        nearest = std::min(nearest, distance_to_hull(pose, post.at(0.25)) - post.radius);
      }
      for (const Eigen::Vector2d& vine : vine_positions(world)) {
        nearest = std::min(nearest, distance_to_hull(pose, vine) - 0.03);
      }
    }
  }
  EXPECT_GT(nearest, 0.10);  // m; the rover deviates from the route by a centimetre
}

TEST(WorldFileTest, AResolvedWorldReadsBackTheSame) {
  const auto file =
      std::filesystem::path(VINEBENCH_SOURCE_DIR) / "worlds" / "typical-vineyard.yaml";
  const WorldConfig world = load_world(file);
  const std::string text = format_yaml(world);
  const test::TestFolder folder;
  const auto copy = load_world(folder.write("copy.yaml", text));
  EXPECT_EQ(format_yaml(copy), text);
  EXPECT_EQ(copy.rows.size(), 10u);
}

TEST(WorldFileTest, ProblemsOfBlocksPostsAndNumbersAreNamed) {
  const std::string block = "block: {rows: 2, length: 10}\n";
  EXPECT_EQ(error_of_world(block), "");
  EXPECT_THAT(error_of_world("block: {rows: 0}\n"),
              AllOf(HasSubstr("world.yaml:1"), HasSubstr("block.rows")));
  EXPECT_THAT(error_of_world("rows: []\n"), HasSubstr("expected at least one row"));
  EXPECT_THAT(error_of_world("block: {length: -3}\n"), HasSubstr("block.length"));
  EXPECT_THAT(error_of_world("block: {spacing: .nan}\n"), HasSubstr("block.spacing"));
  EXPECT_THAT(error_of_world("block: {origin: [0, .inf]}\n"), HasSubstr("block.origin.1"));
  EXPECT_THAT(error_of_world(block + "terrain: {amplitude: .nan}\n"),
              AllOf(HasSubstr("world.yaml:2"), HasSubstr("terrain.amplitude")));
  EXPECT_THAT(error_of_world(block + "boxes: [{size: [1, -1, 1]}]\n"), HasSubstr("boxes.0.size.1"));
  EXPECT_THAT(error_of_world(block + "tags: [{id: 1, post: {row: 2}}]\n"),
              AllOf(HasSubstr("tags.0.post"), HasSubstr("expected a row from 0 to 1, found 2")));
  EXPECT_THAT(error_of_world(block + "tags: [{id: 1, post: {row: 0, index: 9}}]\n"),
              AllOf(HasSubstr("tags.0.post"), HasSubstr("expected an index from -6 to 5")));
  EXPECT_THAT(error_of_world(block + "obstacles: [{kind: bear}]\n"),
              AllOf(HasSubstr("obstacles.0.kind"), HasSubstr("expected one of: person, crate")));
  EXPECT_THAT(error_of_world("rows: [{start: [0, 0], end: [4, 0]}, {start: [0, 1], end: [4, 3]}]\n"
                             "ground: {aisles: grass}\n"),
              HasSubstr("parallel and evenly spaced"));
  EXPECT_THAT(error_of_world("block: {rows: 20, length: 200, spacing: 9}\n"
                             "terrain: {amplitude: 0.1}\n"),
              AllOf(HasSubstr("terrain"), HasSubstr("make terrain.cell larger")));
}

}  // namespace
}  // namespace vinebench::sim
