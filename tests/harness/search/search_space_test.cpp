// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/search_space.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class SearchSpaceTest : public testing::Test {
 protected:
  SearchSpace read(const std::string& text) const {
    return load_search_space(folder_.write("space.yaml", text));
  }
  std::string error(const std::string& text) const {
    return test::error_of([&] { read(text); });
  }

  test::TestFolder folder_;
};

TEST_F(SearchSpaceTest, ValuesLieBetweenTheirNeighboursAndStepsAtTheNearest) {
  const SearchSpace space = read(
      "difficulties:\n"
      "  - {name: sun, between: {world.sun.elevation_deg: [50, 30, 0]}}\n"
      "  - {name: growth, steps: {world.vines.bbch: [65, 75, 89]}}\n");
  // A quarter of the way is half of that to the second of three; 3/4 of it half of the rest.
  EXPECT_THAT(overrides_at(space, {0.25, 0}), ElementsAre(Pair("world.sun.elevation_deg", "40")));
  EXPECT_THAT(overrides_at(space, {0.75, 0}), ElementsAre(Pair("world.sun.elevation_deg", "15")));
  // 0.2 of two steps is 0.4 of one: the first value; 0.3 is 0.6: the second.
  EXPECT_THAT(overrides_at(space, {0, 0.2}), ElementsAre(Pair("world.vines.bbch", "65")));
  EXPECT_THAT(overrides_at(space, {1, 0.3}),
              ElementsAre(Pair("world.sun.elevation_deg", "0"), Pair("world.vines.bbch", "75")));
  EXPECT_THAT(overrides_at(space, {0, 0}), ElementsAre());
  EXPECT_THAT(values_at(space.difficulties[0], 0),
              ElementsAre(Pair("world.sun.elevation_deg", "50")));
  EXPECT_EQ(text_of(space, {0.25, 0}), "sun 0.25 (world.sun.elevation_deg=40)");
  EXPECT_EQ(text_of(space, {0, 0}), "as it is");
}

TEST_F(SearchSpaceTest, RefusesWhatCannotBeMeant) {
  EXPECT_THAT(error("difficulties: []\n"), HasSubstr("expected at least one"));
  EXPECT_THAT(error("difficulties: [{name: sun}]\n"), HasSubstr("expected between or steps"));
  EXPECT_THAT(error("difficulties: [{name: sun, between: {a: [1]}}]\n"),
              HasSubstr("expected two values or more"));
  EXPECT_THAT(error("difficulties: [{name: sun, between: {a: [1, high]}}]\n"), HasSubstr("a"));
  EXPECT_THAT(error("difficulties: [{name: sun, betwen: {a: [1, 2]}}]\n"), HasSubstr("betwen"));
  EXPECT_THAT(error("difficulties:\n"
                    "  - {name: sun, between: {a: [1, 2]}}\n"
                    "  - {name: sun, between: {b: [1, 2]}}\n"),
              HasSubstr("'sun' is there twice"));
  EXPECT_THAT(error("difficulties:\n"
                    "  - {name: sun, between: {a: [1, 2]}}\n"
                    "  - {name: moon, steps: {a: [1, 2]}}\n"),
              HasSubstr("a is changed by two of them"));
}

TEST_F(SearchSpaceTest, NamesTheNearestDifficulty) {
  const SearchSpace space = read(
      "difficulties:\n"
      "  - {name: sun, between: {a: [1, 2]}}\n"
      "  - {name: speed, between: {b: [1, 2]}}\n");
  EXPECT_EQ(difficulty_named(space, "speed"), 1u);
  EXPECT_THAT(test::error_of([&] { difficulty_named(space, "sped"); }), HasSubstr("'speed'"));
}

}  // namespace
}  // namespace vinebench::harness
