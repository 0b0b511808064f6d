// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/cultivar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/plants/grapevine.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_plant.h"

namespace vinebench::sim {
namespace {

TEST(CultivarTest, ThoseThatAreShippedCanBeReadAndGrown) {
  for (const char* name : {"merlot", "cabernet-sauvignon", "chardonnay", "riesling",
                           "sauvignon-blanc", "syrah", "gewuerztraminer"}) {
    const auto file =
        std::filesystem::path(VINEBENCH_SOURCE_DIR) / "cultivars" / (std::string(name) + ".yaml");
    PlantBrief asked = test::brief();
    asked.cultivar = load_cultivar(file);
    EXPECT_EQ(asked.cultivar.name, name);
    const Grapevine vine = grow_grapevine(asked, 1, 0);
    double length = 0;
    for (const Bunch& bunch : vine.bunches) length += static_cast<double>(bunch.length);
    // The mean of a dozen bunches whose lengths differ by 13 %: 4 % times three.
    EXPECT_NEAR(length / static_cast<double>(vine.bunches.size()), asked.cultivar.bunch.length,
                0.12 * asked.cultivar.bunch.length);
  }
}

TEST(CultivarTest, AnUnknownKeyIsNamed) {
  const test::TestFolder folder;
  const auto file = folder.write("odd.yaml", "leaf: {colour: green}\n");
  EXPECT_THAT(test::error_of([&] { load_cultivar(file); }), testing::HasSubstr("leaf.colour"));
}

TEST(CultivarTest, WithoutAFileItIsTheOneBuiltIn) {
  EXPECT_EQ(load_cultivar({}).name, "red");
  EXPECT_EQ(load_cultivar({}).leaf.area, Cultivar().leaf.area);
}

// A bunch wider than long, and a berry wider than half of its bunch.
TEST(CultivarTest, ABunchThatCannotBeIsNamed) {
  const test::TestFolder folder;
  const auto problem = [&](const std::string& text) {
    const auto file = folder.write("odd.yaml", text);
    return test::error_of([&] { load_cultivar(file); });
  };
  EXPECT_THAT(problem("bunch: {length: 0.1, width: 0.12}\n"),
              testing::HasSubstr("longer than wide"));
  EXPECT_THAT(problem("bunch: {width: 0.05}\nberry: {diameter: 0.03}\n"),
              testing::HasSubstr("two or more side by side"));
}

}  // namespace
}  // namespace vinebench::sim
