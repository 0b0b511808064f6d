// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/run_scenario.h"

#include <gmock/gmock.h>

#include "harness/datasets/format/dataset_card.h"
#include "tests/support/court_scenario.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

using RunScenarioTest = test::CourtScenario;

// The second run is of the first one's resolved scenario, on more threads and with a recording.
TEST_F(RunScenarioTest, RepeatsToTheByteWhateverTheThreadsAndTheRecording) {
  RunOptions options;
  options.folder = folder_ / "out";
  prepare_scenario_folder(options.folder, scenario());
  const RunReport first = run_scenario(scenario(), 1, options).report;
  EXPECT_EQ(first.scenario, "court");
  EXPECT_EQ(first.seed, 5);
  EXPECT_EQ(first.frames, kFrames);
  EXPECT_GT(first.cameras.at(0).features, 0);
  EXPECT_TRUE(fs::exists(options.folder / "metrics.json"));

  const ScenarioConfig resolved = load_scenario(options.folder / "scenario.resolved.yaml");
  const RunOutcome second = run_scenario(resolved, 3, {}, RunRecording{folder_ / "data", {}});
  EXPECT_EQ(second.report.hash, first.hash);
  const DatasetCard card = read_card(folder_ / "data");
  EXPECT_TRUE(card.complete);
  EXPECT_EQ(card.frames, kFrames);
}

TEST_F(RunScenarioTest, MapsAreForTheBuiltInCore) {
  ScenarioConfig foreign = scenario();
  foreign.slam.external.emplace();
  RunOptions options;
  options.maps.save = folder_ / "map";
  EXPECT_THAT(test::error_of([&] { run_scenario(foreign, 1, options); }),
              HasSubstr("require the built-in SLAM core"));
  options.maps.save = folder_ / "nowhere/map";
  EXPECT_THAT(test::error_of([&] { run_scenario(scenario(), 1, options); }),
              HasSubstr("nowhere does not exist"));
}

/// Sets an environment variable, and restores it at the end.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    value == nullptr ? unsetenv(name) : setenv(name, value, 1);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(DefaultCacheTest, TakesTheFirstVariableThatIsSet) {
  const Environment own("VINEBENCH_CACHE", "/own");
  const Environment cache("XDG_CACHE_HOME", "/xdg");
  const Environment home("HOME", "/home/me");
  EXPECT_EQ(default_cache(), "/own");
  setenv("VINEBENCH_CACHE", "", 1);
  EXPECT_EQ(default_cache(), "/xdg/vinebench");
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(default_cache(), "/home/me/.cache/vinebench");
  unsetenv("HOME");
  EXPECT_EQ(default_cache(), fs::temp_directory_path() / "vinebench-cache");
}

}  // namespace
}  // namespace vinebench::harness
