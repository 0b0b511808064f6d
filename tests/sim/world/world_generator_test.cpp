// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/world/world_generator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/config/yaml_writer.h"
#include "sim/config_files.h"
#include "sim/world/row_frame.h"
#include "sim/world/row_index.h"
#include "sim/world/world_layout.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;

WorldRecipe small_recipe() {
  WorldRecipe recipe;
  recipe.name = "small";
  recipe.rows = 3;
  recipe.length = 12;
  recipe.row_spacing = 2;
  recipe.heading_deg = 25;
  recipe.cartons = 4;
  recipe.people = 2;
  recipe.seed = 5;
  return recipe;
}

WorldConfig read_back(const WorldRecipe& recipe) {
  const test::TestFolder folder;
  const auto file = folder.write("world.yaml", format_world(recipe));
  return load_world(file);
}

TEST(WorldGeneratorTest, WhatItWritesReadsBackAsTheSameWorld) {
  const WorldConfig made = make_world(small_recipe());
  EXPECT_EQ(format_yaml(read_back(small_recipe())), format_yaml(made));
}

TEST(WorldGeneratorTest, HasTheRowsPlantsAndTagsAskedFor) {
  const WorldConfig world = read_back(small_recipe());
  const WorldLayout layout = lay_out(world);
  ASSERT_EQ(layout.rows.size(), 3u);
  EXPECT_NEAR(layout.terrain.frame().spacing, 2, 1e-9);
  EXPECT_NEAR(layout.terrain.frame().heading(), 25 * 3.14159265358979 / 180, 1e-9);
  EXPECT_EQ(layout.vines.size(), 36u);
  EXPECT_EQ(world.tags.size(), 6u);  // two ends of three rows
  EXPECT_EQ(world.tags[5].id, 5);
  ASSERT_EQ(world.occluders.size(), 6u);  // the cartons first
  EXPECT_NE(world.occluders[0].printed, world.occluders[1].printed);
  EXPECT_EQ(class_of(world.occluders[3]), OccluderClass::kCarton);
  EXPECT_EQ(class_of(world.occluders[4]), OccluderClass::kPerson);
  EXPECT_FALSE(world.terrain.flat());
}

TEST(WorldGeneratorTest, CartonsAndPeopleStandInAisles) {
  WorldRecipe recipe = small_recipe();
  recipe.cartons = 60;
  recipe.people = 30;
  const WorldConfig world = read_back(recipe);
  const RowIndex rows(lay_out(world).rows);
  // At most 0.22 of 2 m off the aisle's middle, which is 1 m from either row, and 1 cm rounded.
  for (const Occluder& occluder : world.occluders) {
    EXPECT_GT(rows.distance(occluder.position), 0.55);
  }
}

TEST(WorldGeneratorTest, TheSeedMovesThingsAndNothingElse) {
  WorldRecipe other = small_recipe();
  other.seed = 6;
  const WorldConfig a = make_world(small_recipe()), b = make_world(other);
  EXPECT_NE(a.occluders[0].position, b.occluders[0].position);
  EXPECT_EQ(a.tags.size(), b.tags.size());
  EXPECT_EQ(format_world(small_recipe()), format_world(small_recipe()));
}

TEST(WorldGeneratorTest, NarrowAislesAreBareSoil) {
  WorldRecipe recipe = small_recipe();
  recipe.row_spacing = 0.8;
  EXPECT_EQ(make_world(recipe).ground.aisles, WorldConfig::Ground::Aisles::kSoil);
  EXPECT_EQ(make_world(small_recipe()).ground.aisles, WorldConfig::Ground::Aisles::kGrass);
}

TEST(WorldGeneratorTest, SaysWhatIsWrongWithARecipe) {
  const auto error_of = [](auto change) {
    WorldRecipe recipe = small_recipe();
    change(recipe);
    return test::error_of([&] { make_world(recipe); });
  };
  EXPECT_THAT(error_of([](WorldRecipe& r) { r.rows = 0; }), HasSubstr("rows: expected"));
  EXPECT_THAT(error_of([](WorldRecipe& r) { r.row_spacing = std::nan(""); }),
              HasSubstr("row_spacing: expected"));
  EXPECT_THAT(error_of([](WorldRecipe& r) { r.length = -1; }), HasSubstr("length: expected"));
  EXPECT_THAT(error_of([](WorldRecipe& r) { r.name = "a/b"; }), HasSubstr("name: expected"));
  EXPECT_THAT(error_of([](WorldRecipe& r) { r.tag_family = "tag99"; }), HasSubstr("tag99"));
  EXPECT_THAT(error_of([](WorldRecipe& r) {
                r.rows = 20;
                r.tag_family = "tag16h5";
              }),
              HasSubstr("expected at most 30 of tag16h5, found 40"));
}

}  // namespace
}  // namespace vinebench::sim
