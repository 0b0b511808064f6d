// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sweep/sweep_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class SweepSpecTest : public testing::Test {
 protected:
  SweepSpec read(const std::string& text) const {
    return load_sweep_spec(folder_.write("spec.yaml", text));
  }
  std::string error(const std::string& text) const {
    return test::error_of([&] { cells_of(read(text)); });
  }

  test::TestFolder folder_;
};

TEST_F(SweepSpecTest, EveryScenarioWithEverySystemAtEveryPoint) {
  const auto cells =
      cells_of(read("scenarios: [row, loop]\n"
                    "seeds: 1..3\n"
                    "set: {slam.threads: 1}\n"
                    "systems:\n"
                    "  front: {slam.cameras: front}\n"
                    "  all: {}\n"
                    "grid:\n"
                    "  world.sun.elevation_deg: [10, 50]\n"
                    "  noise: [1]\n"));
  ASSERT_EQ(cells.size(), 2u * 2u * 2u);
  EXPECT_EQ(cells[0].scenario, "row");
  EXPECT_EQ(cells[0].label(), "all, noise=1 sun.elevation_deg=10");
  EXPECT_EQ(cells[1].label(), "all, noise=1 sun.elevation_deg=50");
  EXPECT_EQ(cells[2].folder(), "front/noise=1,sun.elevation_deg=10");
  EXPECT_EQ(cells[4].scenario, "loop");
  // What is set first is what a system and the grid may replace.
  EXPECT_THAT(cells[3].overrides,
              ElementsAre(Pair("slam.threads", "1"), Pair("slam.cameras", "front"),
                          Pair("noise", "1"), Pair("world.sun.elevation_deg", "50")));
}

TEST_F(SweepSpecTest, ScenariosAloneAreCellsWithoutLabel) {
  const auto cells = cells_of(read("scenarios: row\n"));
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_EQ(cells[0].label(), "");
  EXPECT_EQ(cells[0].folder(), "");
}

// Two long values, and values with signs that a file system or a shell reads otherwise.
TEST_F(SweepSpecTest, FoldersHaveNamesThatAreDifferentAndPlain) {
  const std::string same(120, 'x');
  const auto cells = cells_of(read("scenarios: row\ngrid: {a.b.key: [" + same + "1, " + same +
                                   "2, '[1, 2]', '[1; 2]']}\n"));
  ASSERT_EQ(cells.size(), 4u);
  EXPECT_NE(cells[0].folder(), cells[1].folder());
  EXPECT_NE(cells[2].folder(), cells[3].folder());
  EXPECT_THAT(cells[2].folder().string(), testing::StartsWith("b.key=_1,_2_-"));
  for (const auto& cell : cells) EXPECT_LT(cell.folder().string().size(), 120u);
}

TEST_F(SweepSpecTest, BadOnesAreRefused) {
  EXPECT_THAT(error("seeds: 1..3\n"), HasSubstr("spec.yaml:1: scenarios: expected at least one"));
  EXPECT_THAT(error("scenarios: row\nseeds: 3..1\n"), HasSubstr("spec.yaml: seeds: "));
  EXPECT_THAT(error("scenarios: row\ngrid: {noise: []}\n"),
              HasSubstr("grid.noise: expected at least one value"));
  EXPECT_THAT(error("scenarios: row\ngrid: {noise: [1, 1]}\n"), HasSubstr("there twice"));
  EXPECT_THAT(error("scenarios: row\nsystems: {a/b: {}}\n"), HasSubstr("no '/'"));
  EXPECT_THAT(error("scenarios: row\nrepeats: 0\n"), HasSubstr("repeats"));
  EXPECT_THAT(error("scenarios: row\nseed: 1\n"), HasSubstr("seed"));
}

}  // namespace
}  // namespace vinebench::harness
