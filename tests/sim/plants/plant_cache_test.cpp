// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/plant_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <regex>
#include <set>
#include <sstream>

#include "sim/assets/asset_file.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// One template without leaves: the fastest to grow.
VinesConfig bare_vines() {
  VinesConfig vines;
  vines.templates = 1;
  vines.bbch = 0;
  return vines;
}

/// The only plant in the folder.
std::filesystem::path plant_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> plants;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".glb") plants.push_back(entry.path());
  }
  EXPECT_EQ(plants.size(), 1u);
  return plants.at(0);
}

/// Of what is made once, by its node in the file system.
ino_t node_of(const std::filesystem::path& file) {
  struct stat status {};
  EXPECT_EQ(stat(file.c_str(), &status), 0);
  return status.st_ino;
}

TEST(PlantCacheTest, PlantsAreKeptAndGrownAnewWhereTheirFileIsDamaged) {
  const test::TestFolder folder;
  const std::filesystem::path cache = folder / "cache";
  const PlantSet grown = cached_plants(bare_vines(), 5, cache);
  ASSERT_EQ(grown.grown.size(), 1u);
  EXPECT_THAT(grown.young, IsEmpty());
  const std::filesystem::path file = plant_in(cache);
  const std::string bytes = read_file(file);
  EXPECT_THAT(bytes, HasSubstr(R"("label":"trunk")"));  // a number would change with the labels
  const ino_t node = node_of(file);
  EXPECT_EQ(cached_plants(bare_vines(), 5, cache).grown.size(), 1u);
  EXPECT_EQ(node_of(file), node);  // read, not grown again

  std::string changed = bytes;
  changed.back() ^= 1;  // still a mesh
  for (const std::string& damaged : {bytes.substr(0, bytes.size() / 2), changed}) {
    write_file_atomically(file, damaged);
    cached_plants(bare_vines(), 5, cache);
    EXPECT_EQ(plant_in(cache), file);
    EXPECT_TRUE(read_file(file) == bytes);
  }
}

TEST(PlantCacheTest, APlantOfSomeoneElseIsGrownAnew) {
  const test::TestFolder folder;
  const std::filesystem::path cache = folder / "cache";
  cached_plants(bare_vines(), 5, cache);
  const std::filesystem::path file = plant_in(cache);
  const std::string bytes = read_file(file);
  cached_plants(bare_vines(), 6, folder / "other");
  const std::string other = read_file(plant_in(folder / "other"));
  EXPECT_FALSE(other == bytes);
  const std::filesystem::path target = folder.write("target.glb", other);
  std::filesystem::remove(file);
  std::filesystem::create_symlink(target, file);
  cached_plants(bare_vines(), 5, cache);
  EXPECT_FALSE(std::filesystem::is_symlink(file));
  EXPECT_TRUE(read_file(file) == bytes);
  EXPECT_TRUE(read_file(target) == other);
}

TEST(PlantCacheTest, WithoutACacheThePlantsAreTheSameAndOneNoticeTellsWhy) {
  const test::TestFolder folder;
  cached_plants(bare_vines(), 5, folder / "cache");
  const std::string kept = to_glb(cached_plants(bare_vines(), 5, folder / "cache").grown.at(0));
  VinesConfig vines = bare_vines();
  vines.young = 0.5;  // three files, of which none can be kept
  for (const std::filesystem::path& place :
       {folder.write("file", "x"), std::filesystem::path("/proc/none"), std::filesystem::path()}) {
    std::vector<std::string> notices;
    CacheFolder cache{place};
    cache.notice = [&](const std::string& text) { notices.push_back(text); };
    EXPECT_TRUE(to_glb(cached_plants(bare_vines(), 5, cache).grown.at(0)) == kept);
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_THAT(notices[0], AllOf(HasSubstr("are not kept"), HasSubstr(place.string())));
    cached_plants(vines, 5, cache);
    EXPECT_EQ(notices.size(), 2u);
    cache.notice = {};
    EXPECT_EQ(cached_plants(bare_vines(), 5, cache).grown.size(), 1u);
  }
}

/// Files of more than some bytes cannot be written, as on a full disk.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  rlimit before_{};
  void (*signal_)(int);
};

TEST(PlantCacheTest, AFullDiskIsANoticeAndLeavesNothing) {
  const test::TestFolder folder;
  CacheFolder cache{folder / "cache"};
  std::vector<std::string> notices;
  cache.notice = [&](const std::string& text) { notices.push_back(text); };
  {
    const SmallFiles limit(10'000);
    EXPECT_EQ(cached_plants(bare_vines(), 5, cache).grown.size(), 1u);
  }
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_THAT(notices[0], HasSubstr("File too large"));
  EXPECT_TRUE(std::filesystem::is_empty(cache.folder));
}

TEST(PlantCacheTest, SeveralProcessesMayFillItAtOnce) {
  const test::TestFolder folder;
  const std::filesystem::path cache = folder / "cache";
  std::vector<pid_t> processes;
  for (int i = 0; i < 6; ++i) {
    const pid_t process = fork();
    ASSERT_GE(process, 0);
    if (process == 0) {
      bool told = false;
      CacheFolder own{cache};
      own.notice = [&](const std::string&) { told = true; };
      const bool whole = cached_plants(bare_vines(), 5, own).grown.size() == 1;
      _exit(whole && !told ? 0 : 1);
    }
    processes.push_back(process);
  }
  for (const pid_t process : processes) {
    int status = -1;
    waitpid(process, &status, 0);
    EXPECT_EQ(status, 0);
  }
  const ino_t node = node_of(plant_in(cache));
  cached_plants(bare_vines(), 5, cache);
  EXPECT_EQ(node_of(plant_in(cache)), node);
}

// The values that core/config reads stand in the key themselves; errors, reading files and the
// cache shape nothing, nor do the meshes that stand in place of plants.
bool shapes_no_plant(const std::string& path) {
  return path.starts_with("core/config/") || path.starts_with("core/util/error") ||
         path.starts_with("core/files/") || path.starts_with("sim/assets/foreign/");
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
