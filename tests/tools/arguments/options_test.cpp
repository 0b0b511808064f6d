// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/arguments/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/test_folder.h"

namespace vinebench::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

enum class Terrain { kFlat, kHilly };

std::vector<std::string> yaml_names(Terrain) {
  return {"flat", "hilly"};
}

TEST(Options, OverridesAreSplitAtTheFirstEqualsSign) {
  EXPECT_THAT(parse_overrides({"a.b=1", "c=d=e"}), ElementsAre(Pair("a.b", "1"), Pair("c", "d=e")));
  EXPECT_THAT(test::error_of([] { parse_overrides({"a"}); }), HasSubstr("expected KEY=VALUE"));
}

TEST(Options, AnEnumIsChosenByName) {
  Terrain terrain = Terrain::kFlat;
  choose(terrain, "hilly");
  EXPECT_EQ(terrain, Terrain::kHilly);
}

TEST(Options, ThreadsAreAtLeastOne) {
  int threads = default_threads();
  EXPECT_GE(threads, 1);
  const Option option = threads_option(threads);
  ASSERT_TRUE(option.range);
  EXPECT_FALSE(option.range->contains(0));
  EXPECT_EQ(std::get<int*>(option.target), &threads);
}

TEST(Options, TheCacheReplacesThatOfTheMachine) {
  std::filesystem::path folder;
  EXPECT_EQ(std::get<std::filesystem::path*>(cache_option(folder).target), &folder);
  harness::Machine machine;
  machine.plant_cache.folder = "/home/anne/.cache/vinebench";
  EXPECT_EQ(with_cache(machine, folder).plant_cache.folder, "/home/anne/.cache/vinebench");
  EXPECT_EQ(with_cache(machine, "plants").plant_cache.folder, "plants");
}

TEST(Options, MapsAreLoadedFromExistingFilesAlone) {
  harness::MapFiles maps;
  const std::vector<Option> options = map_options(maps);
  ASSERT_EQ(options.size(), 3U);
  EXPECT_EQ(options[0].existing, Existing::kFile);
  EXPECT_EQ(std::get<std::filesystem::path*>(options[0].target), &maps.load);
  EXPECT_EQ(std::get<std::filesystem::path*>(options[1].target), &maps.save);
  EXPECT_EQ(options[1].existing, Existing::kAnything);
  EXPECT_EQ(std::get<std::filesystem::path*>(options[2].target), &maps.cloud);
}

}  // namespace
}  // namespace vinebench::tools
