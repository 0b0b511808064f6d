// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/run_scenario.h"

#include <gmock/gmock.h>

#include "core/files/files.h"
#include "harness/datasets/files/json_file.h"
#include "harness/datasets/format/dataset_card.h"
#include "harness/run/system_failure.h"
#include "tests/support/court_scenario.h"
#include "tests/support/plugins.h"

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
  RunRecording recording{folder_ / "data", {}};
  recording.options.cameras = {"right"};  // the core sees both
  const RunOutcome second = run_scenario(resolved, machine(), 3, {}, recording);
  EXPECT_EQ(second.report.hash, first.hash);
  const DatasetCard card = read_card(folder_ / "data");
  EXPECT_TRUE(card.complete);
  EXPECT_EQ(card.frames, kFrames);
  EXPECT_EQ(card.cameras, recording.options.cameras);
}

TEST_F(RunScenarioTest, ARecordingInUseIsAnError) {
  const FolderLock other(folder_ / "data");
  EXPECT_THAT(test::error_of([&] {
                run_scenario(scenario(), machine(), 1, {}, RunRecording{folder_ / "data", {}});
              }),
              HasSubstr("another process is writing there"));
}

TEST_F(RunScenarioTest, APluginsFailureIsItsVerdict) {
  ScenarioConfig plugged = scenario();
  plugged.slam.plugin =
      PluginSlamConfig{.library = test::beside_test("fake_plugin.so"), .settings = "exit.frame"};
  Machine with_host = machine();
  with_host.plugin_host = test::beside_test("vinebench_plugin_host");
  const RunReport report = run_scenario(plugged, with_host, 2, {}).report;
  EXPECT_EQ(report.frames, 3);
  EXPECT_THAT(report.failure.value().cause, HasSubstr("its process ended: exit code 0"));
  EXPECT_FALSE(all_hold(report.checks));
}

// The world's mesh is gone, which would be the first thing to be missed in a drive.
TEST_F(RunScenarioTest, AProgramThatCannotBeExecutedIsFoundBeforeTheDrive) {
  ScenarioConfig foreign = scenario();
  foreign.slam.external.emplace().program = folder_.write("slam.sh", "#!/bin/sh\n");
  foreign.simulation.world.vines.meshes = {folder_ / "gone.glb"};
  EXPECT_THAT(test::error_of([&] { run_scenario(foreign, machine(), 1, {}); }),
              HasSubstr("slam.sh: cannot be started: Permission denied"));
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

/// A system of the caller's that stays where it began.
class StandingSlam : public SlamSystem {
 public:
  Estimate process(const Frame& frame) override {
    if (frame.index == fails_at) fail_system("no idea");
    Estimate estimate;
    estimate.stamp = frame.stamp;
    estimate.status = TrackingStatus::kTracking;
    estimate.T_map_body = Pose();
    estimate.cameras.resize(2);
    summary_.trajectory.push_back({frame.stamp, Pose()});
    return estimate;
  }
  SlamSummary finish() override { return summary_; }
  const StageTimes& times() const override { return times_; }

  std::int64_t fails_at = -1;

 private:
  SlamSummary summary_;
  StageTimes times_;
};

// Judged by the expectation that it breaks, and without the guard, of the built-in core.
TEST_F(RunScenarioTest, ASystemOfTheCallersIsGivenTheRigAndJudged) {
  ScenarioConfig judged = scenario();
  judged.expectations.ate_origin_rmse_max = 1e-6;
  judged.guard.emplace().bounds.coverage_min = 2;
  const auto make = [](const SystemSetup& setup) {
    EXPECT_EQ(setup.rig.name, "pair");
    EXPECT_EQ(setup.wheels.value().radius, 0.10);
    EXPECT_EQ(setup.threads, 2);
    return std::make_unique<StandingSlam>();
  };
  const RunReport report = run_scenario_with(make, judged, machine(), 2, {}).report;
  EXPECT_EQ(report.frames, kFrames);
  EXPECT_EQ(report.results.coverage, 1);
  EXPECT_FALSE(report.hash.empty());
  ASSERT_EQ(report.checks.size(), 1u);
  EXPECT_FALSE(report.checks[0].ok);  // the rover drove some centimetres
}

TEST_F(RunScenarioTest, AFailureOfTheCallersSystemIsItsVerdict) {
  const auto failing = [](const SystemSetup&) {
    auto slam = std::make_unique<StandingSlam>();
    slam->fails_at = 3;
    return slam;
  };
  const RunReport report = run_scenario_with(failing, scenario(), machine(), 1, {}).report;
  EXPECT_EQ(report.failure.value().cause, "no idea");
  EXPECT_EQ(report.failure->frame, 3);
  const auto unmade = [](const SystemSetup&) -> std::unique_ptr<SlamSystem> {
    fail_system("no start");
  };
  EXPECT_EQ(run_scenario_with(unmade, scenario(), machine(), 1, {}).report.failure.value().cause,
            "no start");
  ScenarioConfig twice = scenario();
  twice.earlier_visit.emplace().duration = 1;
  EXPECT_THAT(test::error_of([&] { run_scenario_with(failing, twice, machine(), 1, {}); }),
              HasSubstr("earlier_visit: requires the built-in SLAM core"));
}

/// The court with a camera pair that can be tracked, visited twice.
class SecondVisitTest : public RunScenarioTest {
 protected:
  SecondVisitTest() { write_large_rig(); }
  ScenarioConfig visited() const {
    ScenarioConfig config = scenario();
    config.earlier_visit.emplace().duration = 1;
    return config;
  }
};

// 16 frames of a second at 15 Hz. The map is known: the second visit's first frame waits for its
// place (kInitializing), where a run without a map initialises at once.
TEST_F(SecondVisitTest, ItsMapIsWhereTheRunBegins) {
  RunOptions options;
  options.folder = folder_ / "out";
  const FolderLock lock = prepare_scenario_folder(options.folder, visited());
  const RunReport report = run_scenario(visited(), machine(), 1, options).report;
  EXPECT_EQ(report.frames, kFrames);
  const auto earlier =
      nlohmann::json::parse(read_file(options.folder / "earlier-visit/metrics.json"));
  EXPECT_EQ(earlier["frames"], 16);
  EXPECT_EQ(earlier["scenario"], "court (earlier visit)");  // compare finds two runs
  EXPECT_TRUE(earlier["expectations"].empty());
  const RunReport alone = run_scenario(scenario(), machine(), 1, {}).report;
  EXPECT_EQ(alone.results.coverage, 1);
  EXPECT_LT(report.results.coverage, 1);
  EXPECT_NE(report.hash, alone.hash);
}

TEST_F(SecondVisitTest, RepeatsToTheByte) {
  const RunReport first = run_scenario(visited(), machine(), 1, {}).report;
  EXPECT_EQ(run_scenario(visited(), machine(), 3, {}).report.hash, first.hash);
}

TEST_F(SecondVisitTest, AnotherMapIsRefused) {
  RunOptions options;
  options.maps.load = folder_ / "map";
  EXPECT_THAT(test::error_of([&] { run_scenario(visited(), machine(), 1, options); }),
              HasSubstr("begins with the map of its own earlier_visit"));
}

TEST_F(SecondVisitTest, AnInterruptionThereEndsTheRun) {
  RunOptions options;
  options.stopped = [] { return true; };
  EXPECT_TRUE(run_scenario(visited(), machine(), 1, options).interrupted);
}

}  // namespace
}  // namespace vinebench::harness
