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
  const FolderLock lock = prepare_scenario_folder(options.folder, scenario());
  const RunReport first = run_scenario(scenario(), machine(), 1, options).report;
  EXPECT_EQ(first.scenario, "court");
  EXPECT_EQ(first.seed, 5);
  EXPECT_EQ(first.frames, kFrames);
  EXPECT_GT(first.cameras.at(0).features, 0);
  EXPECT_TRUE(fs::exists(options.folder / "metrics.json"));

  const ScenarioConfig resolved = load_scenario(options.folder / "scenario.resolved.yaml");
  const RunOutcome second =
      run_scenario(resolved, machine(), 3, {}, RunRecording{folder_ / "data", {}});
  EXPECT_EQ(second.report.hash, first.hash);
  const DatasetCard card = read_card(folder_ / "data");
  EXPECT_TRUE(card.complete);
  EXPECT_EQ(card.frames, kFrames);
}

TEST_F(RunScenarioTest, ARecordingInUseIsAnError) {
  const FolderLock other(folder_ / "data");
  EXPECT_THAT(test::error_of([&] {
                run_scenario(scenario(), machine(), 1, {}, RunRecording{folder_ / "data", {}});
              }),
              HasSubstr("another process is writing there"));
}

TEST_F(RunScenarioTest, MapsAreForTheBuiltInCore) {
  ScenarioConfig foreign = scenario();
  foreign.slam.external.emplace();
  RunOptions options;
  options.maps.save = folder_ / "map";
  EXPECT_THAT(test::error_of([&] { run_scenario(foreign, machine(), 1, options); }),
              HasSubstr("require the built-in SLAM core"));
  options.maps.save = folder_ / "nowhere/map";
  EXPECT_THAT(test::error_of([&] { run_scenario(scenario(), machine(), 1, options); }),
              HasSubstr("nowhere does not exist"));
}

}  // namespace
}  // namespace vinebench::harness
