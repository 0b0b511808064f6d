// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/make_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/config_files.h"
#include "sim/world/world_layout.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

WorldRequest request(const test::TestFolder& folder) {
  WorldRequest request;
  request.recipe.name = "two rows";
  request.recipe.rows = 2;
  request.recipe.length = 4;
  request.recipe.terrain = sim::WorldRecipe::Relief::kEven;
  request.out = folder / "world.yaml";
  return request;
}

TEST(MakeWorldTest, WritesTheWorldAndSaysWhatItHolds) {
  const test::TestFolder folder;
  const std::string line = make_world(request(folder));
  const sim::WorldConfig world = sim::load_world(folder / "world.yaml");
  EXPECT_EQ(world.name, "two rows");
  ASSERT_TRUE(world.block);
  EXPECT_EQ(world.block->rows, 2);
  // Two rows of 4 m with a plant each metre, and a tag at every row's end.
  EXPECT_THAT(line, testing::StartsWith(request(folder).out + ": 2 rows, 8 vines, "));
  EXPECT_THAT(line, testing::EndsWith(" posts, 4 tags\n"));
}

TEST(MakeWorldTest, OverwritesAFileOnlyByForce) {
  const test::TestFolder folder;
  WorldRequest wanted = request(folder);
  folder.write("world.yaml", "mine");
  EXPECT_THAT(test::error_of([&] { make_world(wanted); }),
              HasSubstr("world.yaml exists; give --force"));
  EXPECT_EQ(read_file(folder / "world.yaml"), "mine");
  wanted.force = true;
  make_world(wanted);
  EXPECT_EQ(sim::lay_out(sim::load_world(folder / "world.yaml")).rows.size(), 2u);
}

TEST(MakeWorldTest, AFaultyRecipeLeavesNoFile) {
  const test::TestFolder folder;
  WorldRequest wanted = request(folder);
  wanted.recipe.rows = 0;
  EXPECT_THAT(test::error_of([&] { make_world(wanted); }), HasSubstr("rows"));
  EXPECT_FALSE(std::filesystem::exists(wanted.out));
}

}  // namespace
}  // namespace vinebench::harness
