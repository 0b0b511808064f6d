// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/machine.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <map>
#include <optional>
#include <string>

namespace vinebench::harness {
namespace {

/// Starts each test without the variables, and restores them afterwards.
class MachineTest : public ::testing::Test {
 protected:
  MachineTest() {
    for (const char* name :
         {"VINEBENCH_GL", "VINEBENCH_CACHE", "XDG_CACHE_HOME", "HOME", "TMPDIR"}) {
      const char* value = getenv(name);
      before_[name] = value == nullptr ? std::nullopt : std::optional<std::string>(value);
      unsetenv(name);
    }
  }
  ~MachineTest() override {
    for (const auto& [name, value] : before_) {
      value ? setenv(name.c_str(), value->c_str(), 1) : unsetenv(name.c_str());
    }
  }

 private:
  std::map<std::string, std::optional<std::string>> before_;
};

TEST_F(MachineTest, ThePlatformIsThatOfTheVariable) {
  EXPECT_EQ(machine_of_environment().gl_platform, "");
  setenv("VINEBENCH_GL", "osmesa", 1);
  EXPECT_EQ(machine_of_environment().gl_platform, "osmesa");
}

TEST_F(MachineTest, TheCacheIsTheFirstOfFourFolders) {
  EXPECT_EQ(machine_of_environment().plant_cache.folder,
            std::filesystem::temp_directory_path() / fmt::format("vinebench-cache-{}", geteuid()));
  setenv("HOME", "/home/anne", 1);
  EXPECT_EQ(machine_of_environment().plant_cache.folder, "/home/anne/.cache/vinebench");
  setenv("XDG_CACHE_HOME", "/var/cache", 1);
  EXPECT_EQ(machine_of_environment().plant_cache.folder, "/var/cache/vinebench");
  setenv("VINEBENCH_CACHE", "/plants", 1);
  EXPECT_EQ(machine_of_environment().plant_cache.folder, "/plants");
}

TEST_F(MachineTest, WithoutAnyFolderThereIsNoCache) {
  setenv("TMPDIR", "/nowhere", 1);
  EXPECT_EQ(machine_of_environment().plant_cache.folder, "");
}

TEST_F(MachineTest, AnEmptyVariableIsNone) {
  setenv("HOME", "/home/anne", 1);
  setenv("VINEBENCH_CACHE", "", 1);
  setenv("VINEBENCH_GL", "", 1);
  EXPECT_EQ(machine_of_environment().plant_cache.folder, "/home/anne/.cache/vinebench");
  EXPECT_EQ(machine_of_environment().gl_platform, "");
}

}  // namespace
}  // namespace vinebench::harness
