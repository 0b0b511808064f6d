// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/plant_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "sim/assets/asset_file.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::filesystem::path only_file(const test::TestFolder& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    files.push_back(entry.path());
  }
  EXPECT_EQ(files.size(), 1u);
  return files.at(0);
}

TEST(PlantCacheTest, PlantsAreKeptAndGrownAnewWhereTheirFileIsDamaged) {
  const test::TestFolder cache;
  VinesConfig vines;
  vines.templates = 1;
  vines.bbch = 0;  // without leaves: the fastest to grow
  const PlantSet grown = cached_plants(vines, 5, cache.path());
  ASSERT_EQ(grown.grown.size(), 1u);
  EXPECT_THAT(grown.young, IsEmpty());
  const std::filesystem::path file = only_file(cache);
  const std::string bytes = read_file(file);
  EXPECT_THAT(bytes, HasSubstr(R"("label":"trunk")"));  // a number would change with the labels
  EXPECT_EQ(cached_plants(vines, 5, cache.path()).grown.size(), 1u);
  EXPECT_EQ(read_file(file), bytes);  // read, not grown again

  write_file_atomically(file, bytes.substr(0, bytes.size() / 2));
  cached_plants(vines, 5, cache.path());
  EXPECT_EQ(only_file(cache), file);
  EXPECT_TRUE(read_file(file) == bytes);
}

TEST(PlantCacheTest, AFileInTheCachesPlaceIsNamed) {
  const test::TestFolder folder;
  const auto file = folder.write("cache", "x");
  EXPECT_THAT(test::error_of([&] { cached_plants({}, 1, file); }), HasSubstr(file.string()));
}

// The values that core/config reads stand in the key themselves; error.h and files.* shape nothing,
// nor do the meshes that stand in place of plants.
bool shapes_no_plant(const std::string& path) {
  return path.starts_with("core/config/") || path.starts_with("core/util/error") ||
         path.starts_with("core/util/files") || path.starts_with("sim/assets/foreign/");
}

/// The project's files that a source includes, and the .cpp beside each.
std::vector<std::string> needed_by(const std::filesystem::path& root, const std::string& source) {
  std::istringstream lines(read_file(root / source));
  const std::regex include("#include \"(.+)\"");
  std::vector<std::string> needed;
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_match(line, match, include)) continue;
    needed.push_back(match[1]);
    const auto beside = std::filesystem::path(match[1].str()).replace_extension(".cpp");
    if (std::filesystem::exists(root / beside)) needed.push_back(beside.string());
  }
  return needed;
}

TEST(PlantCacheTest, TheKeyCoversEverySourceThatShapesAPlant) {
  const std::filesystem::path root = VINEBENCH_SOURCE_DIR;
  std::set<std::string> covered;
  std::istringstream list(VINEBENCH_PLANT_SOURCES);
  for (std::string file; std::getline(list, file, ':');) {
    covered.insert(std::filesystem::relative(file, root).string());
  }
  ASSERT_TRUE(covered.contains("sim/plants/plant_cache.cpp"));
  for (const std::string& source : covered) {
    for (const std::string& needed : needed_by(root, source)) {
      EXPECT_TRUE(covered.contains(needed) || shapes_no_plant(needed))
          << source << " needs " << needed
          << ", which sim/CMakeLists.txt leaves out of plant_sources";
    }
  }
}

}  // namespace
}  // namespace vinebench::sim
