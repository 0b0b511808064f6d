// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/trust.h"

#include <gmock/gmock.h>

#include "tests/support/court_scenario.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Its rover's model lies among the data of the program.
class TrustTest : public test::CourtScenario {
 protected:
  std::string refusal(const ScenarioConfig& scenario) const {
    return test::error_of([&] { check_untrusted(scenario, file_, untrusted_); });
  }
  const Untrusted untrusted_{{VINEBENCH_SOURCE_DIR}};
};

TEST_F(TrustTest, FilesOfTheScenarioAreAllThatItsValuesName) {
  const std::set<fs::path> files = files_of(scenario());
  EXPECT_THAT(files, Contains(folder_ / "rig.yaml"));
  EXPECT_THAT(files, Contains(fs::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover/rover.xml"));
  EXPECT_THAT(files, Not(Contains(file_)));
}

TEST_F(TrustTest, OwnFilesAndThoseOfTheProgramAreAllowed) {
  EXPECT_EQ(refusal(scenario()), "");
}

TEST_F(TrustTest, CodeIsNotAllowed) {
  ScenarioConfig plugged = scenario();
  plugged.slam.plugin = PluginSlamConfig{.library = folder_.write("own.so", "")};
  EXPECT_THAT(refusal(plugged),
              AllOf(HasSubstr("court.yaml: slam.plugin: is code, "), HasSubstr("own.so")));
  ScenarioConfig external = scenario();
  external.slam.external.emplace().program = folder_.write("own.sh", "");
  EXPECT_THAT(refusal(external),
              AllOf(HasSubstr("court.yaml: slam.external: is a program, "), HasSubstr("own.sh")));
}

TEST_F(TrustTest, OtherFilesAreNotAllowed) {
  EXPECT_THAT(test::error_of([&] { check_untrusted(scenario(), file_, {}); }),
              AllOf(HasSubstr("court.yaml: names "), HasSubstr("rover.xml")));
  ScenarioConfig reading = scenario();
  reading.simulation.world.vines.cultivar = "/etc/passwd";
  EXPECT_THAT(refusal(reading), HasSubstr("names /etc/passwd, which lies neither in"));
}

// The link lies in the scenario's folder, its file does not. The folder "data" is no part of the
// folder "data-2".
TEST_F(TrustTest, LinksAndNamesThatBeginLikeAFolderAreNotAllowed) {
  ScenarioConfig reading = scenario();
  fs::create_symlink("/etc/passwd", folder_ / "cultivar.yaml");
  reading.simulation.world.vines.cultivar = folder_ / "cultivar.yaml";
  EXPECT_THAT(refusal(reading), HasSubstr("cultivar.yaml, which lies neither in"));

  for (const char* name : {"own", "data", "data-2"}) fs::create_directories(folder_ / name);
  reading = {};
  reading.simulation.world.vines.cultivar = folder_.write("data-2/cultivar.yaml", "name: red\n");
  EXPECT_THAT(test::error_of([&] {
                check_untrusted(reading, folder_ / "own/court.yaml", {{folder_ / "data"}});
              }),
              HasSubstr("data-2/cultivar.yaml, which lies neither in"));
}

}  // namespace
}  // namespace vinebench::harness
