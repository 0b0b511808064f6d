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
#include "sim/world/world_layout.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;
using testing::Not;

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
  const WorldLayout layout = lay_out(world);
  EXPECT_EQ(world.name, "csl-vineyard");
  ASSERT_EQ(layout.rows.size(), 3u);
  for (const RowConfig& row : layout.rows) EXPECT_EQ((row.end - row.start).norm(), 4);
  EXPECT_EQ(layout.vines.size(), 12u);  // 4 of each row, 1 m apart
  EXPECT_EQ(layout.posts.size(), 9u);   // 3 of each row, 2 m apart
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

TEST(WorldFileTest, MeshesAreImportedAsTheFileSays) {
  const test::TestFolder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  const std::string row = "rows: [{start: [0, 0], end: [4, 0]}]\n";
  const auto load = [&](const std::string& vines) {
    return load_world(folder.write("world.yaml", row + "vines: " + vines + "\n"));
  };
  // Worlds without the key are written as before there was one.
  EXPECT_THAT(format_yaml(load("{meshes: [a.obj]}")), Not(HasSubstr("mesh_import")));
  const WorldConfig world = load(
      "{meshes: [a.obj], mesh_import: {scale: 0.01, up_axis: y, yaw_deg: 90, "
      "labels: {Bark.001: trunk}, default_label: leaf}}");
  ASSERT_TRUE(world.vines.mesh_import);
  EXPECT_EQ(world.vines.mesh_import->scale, 0.01);
  EXPECT_EQ(world.vines.mesh_import->up_axis, UpAxis::kY);
  EXPECT_EQ(world.vines.mesh_import->yaw_deg, 90);
  EXPECT_EQ(world.vines.mesh_import->labels.at("Bark.001"), Label::kTrunk);
  EXPECT_EQ(world.vines.mesh_import->default_label, Label::kLeaf);
  const std::string text = format_yaml(world);
  EXPECT_EQ(format_yaml(load_world(folder.write("again.yaml", text))), text);

  const auto problem = [&](const std::string& import) {
    return test::error_of([&] { load("{meshes: [a.obj], mesh_import: " + import + "}"); });
  };
  EXPECT_THAT(problem("{labels: {Bark: trnk}}"),
              AllOf(HasSubstr("world.yaml:2: vines.mesh_import.labels.Bark: expected one of: "),
                    HasSubstr("did you mean 'trunk'?")));
  EXPECT_THAT(problem("{lables: {}}"), HasSubstr("did you mean 'labels'?"));
  EXPECT_THAT(problem("{up_axis: w}"), HasSubstr("expected one of: file, x, y, z"));
  EXPECT_THAT(problem("{scale: 0}"), HasSubstr("vines.mesh_import.scale"));
  EXPECT_THAT(problem("{yaw_deg: 361}"), HasSubstr("vines.mesh_import.yaw_deg"));
  EXPECT_THAT(problem("{default_label: sky}"), HasSubstr("a label other than sky"));
  EXPECT_THAT(problem("{labels: {a: sky}}"), HasSubstr("a label other than sky"));
  EXPECT_THAT(test::error_of([&] { load("{mesh_import: {scale: 2}}"); }),
              HasSubstr("vines.mesh_import: expected only with `meshes`"));
}

TEST(WorldFileTest, TheShippedWorldsAreWhatTheySay) {
  const auto load = [](const char* name) {
    const auto file = std::filesystem::path(VINEBENCH_SOURCE_DIR) / "worlds" / name;
    return load_world(file);
  };
  const WorldConfig typical = load("typical-vineyard.yaml");
  const WorldLayout laid = lay_out(typical);
  EXPECT_EQ(laid.rows.size(), 10u);
  EXPECT_GE(laid.vines.size(), 300u);
  EXPECT_EQ(registered_tags(typical, 1).size(), 20u);
  EXPECT_FALSE(typical.terrain.flat());
  EXPECT_TRUE(laid.terrain.frame().regular);
  EXPECT_NEAR(laid.terrain.frame().spacing, 2.5, 1e-9);
  const WorldConfig many = load("many-rows.yaml");
  EXPECT_EQ(lay_out(many).rows.size(), 10u);
  EXPECT_EQ(registered_tags(many, 1).size(), 1u);
  EXPECT_TRUE(many.terrain.flat());
  EXPECT_LE(many.vines.templates, 3);
  // The authors' route changes aisles at x = -0.46 m and 6.95 m (the rover's near side).
  for (const TrellisPost& post : lay_out(many).posts) {
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
  const WorldLayout world = lay_out(load_world(file));
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
      for (const TrellisPost& post : world.posts) {
        nearest = std::min(nearest, distance_to_hull(pose, post.at(0.25)) - post.radius);
      }
      for (const VinePlace& vine : world.vines) {
        nearest = std::min(nearest, distance_to_hull(pose, vine.foot) - 0.03);
      }
    }
  }
  EXPECT_GT(nearest, 0.10);  // m; the rover deviates from the route by a centimetre
}

TEST(WorldFileTest, AResolvedWorldReadsBackTheSame) {
  const auto file =
      std::filesystem::path(VINEBENCH_SOURCE_DIR) / "worlds" / "typical-vineyard.yaml";
  const WorldConfig world = load_world(file);
  const std::string text = format_yaml(written_out(world));
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
