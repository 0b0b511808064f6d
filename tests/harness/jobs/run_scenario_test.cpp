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

class RunScenarioTest : public test::CourtScenario {
 protected:
  RunOutcome run(int threads, const fs::path& out = {},
                 const std::optional<RunRecording>& recording = std::nullopt) {
    RunOptions options;
    options.folder = out;
    if (!out.empty()) prepare_scenario_folder(out, scenario());
    return run_scenario(scenario(), machine(), threads, options, recording);
  }
};

TEST_F(RunScenarioTest, ThreadsAndARecordingChangeNoByteOfTheRun) {
  const RunOutcome alone = run(1, folder_ / "out");
  EXPECT_EQ(alone.report.scenario, "court");
  EXPECT_EQ(alone.report.seed, 5);
  EXPECT_EQ(alone.report.frames, kFrames);
  EXPECT_GT(alone.report.cameras.at(0).features, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/metrics.json"));
  const RunOutcome recorded = run(3, {}, RunRecording{folder_ / "data", {}});
  EXPECT_EQ(recorded.report.hash, alone.report.hash);
  const DatasetCard card = read_card(folder_ / "data");
  EXPECT_TRUE(card.complete);
  EXPECT_EQ(card.frames, kFrames);
}

TEST_F(RunScenarioTest, TheFolderHasTheScenarioThatRepeatsTheRun) {
  prepare_scenario_folder(folder_ / "out", scenario());
  const ScenarioConfig again = load_scenario(folder_ / "out/scenario.resolved.yaml");
  EXPECT_EQ(run_scenario(again, machine(), 2, {}).report.hash, run(2).report.hash);
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
