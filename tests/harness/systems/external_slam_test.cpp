// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/systems/external_slam.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core/mat.hpp>

#include "core/config/validate.h"
#include "core/files/files.h"
#include "harness/report/run_folder.h"
#include "harness/run.h"
#include "tests/support/fakes.h"
#include "tests/support/processes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The fakes' rig; its first camera is 0.1 m in front of the body and 0.5 m above it.
RecordingNotes notes() {
  RecordingNotes notes;
  for (const RigCamera& camera : test::fake_rig().cameras) {
    RigConfig::Camera c;
    c.name = camera.name;
    c.width = 16;
    c.height = 16;
    c.position = {0.1, 0, 0.5};
    notes.rig.cameras.push_back(c);
  }
  notes.rig.rate_hz = test::kFakeRate;
  return notes;
}

class ExternalSlamTest : public testing::Test {
 protected:
  /// Runs a shell script as the system, on 21 frames of 0.1 s.
  RunOutcome run(const std::string& script) {
    config_.program = folder_.write("slam.sh", "#!/bin/sh\n" + script + "\n");
    fs::permissions(config_.program, fs::perms::owner_all);
    test::prepare_fake_folder(folder_.path());
    test::FakeSource source(1, 21);
    const auto slam = make_external_slam(config_, notes(), folder_.path(), stopped_);
    RunOptions options;
    options.folder = folder_.path();
    options.stopped = stopped_;
    return run_lockstep_and_judge(test::fake_trial(), source, *slam, options);
  }
  /// Why the run failed after its last frame.
  std::string failure(const std::string& script) {
    const RunReport report = run(script).report;
    EXPECT_EQ(report.frames, 21);
    EXPECT_FALSE(all_hold(report.checks));
    EXPECT_FALSE(report.failure.value().frame);
    return report.failure->cause;
  }
  /// Why there is no run.
  std::string refusal() {
    return test::error_of([&] { make_external_slam(config_, notes(), folder_.path(), {}); });
  }

  test::TestFolder folder_;
  ExternalSlamConfig config_;
  std::function<bool()> stopped_;
};

/// A pose at the origin for every frame but the first and the last five; stamps in ns.
constexpr const char* kStand =
    "sed -n '3,17p' \"$1/frames.csv\" | sed 's/$/ 0 0 0 0 0 0 1/' >\"$2/trajectory.txt\"";

TEST_F(ExternalSlamTest, FramesWithoutAPoseCountAgainstCoverage) {
  const RunOutcome outcome = run(kStand);
  EXPECT_DOUBLE_EQ(outcome.report.results.coverage, 15.0 / 21);
  EXPECT_EQ(outcome.report.results.losses, 1);
  EXPECT_EQ(outcome.report.results.lost_frames, 5);
  EXPECT_EQ(read_tum(folder_ / "estimate.tum").size(), 15u);
  EXPECT_EQ(read_tum(folder_ / "estimate_live.tum").size(), 15u);
  // Stamps 0.1 to 1.5 s of a circle: the first pose is the origin of the map.
  EXPECT_GT(outcome.report.results.corrected.value().origin.rmse, 0.1);
  EXPECT_FALSE(fs::exists(folder_ / "recording"));
}

TEST_F(ExternalSlamTest, TheRecordingHasAllButTheTruth) {
  config_.keep_recording = true;
  config_.arguments = {"--in={recording}", "{output}/out.txt"};
  config_.trajectory = "out.txt";
  run("[ \"$1\" = \"--in=$VINEBENCH_RECORDING\" ] && [ \"$2\" = \"$VINEBENCH_OUTPUT/out.txt\" ] &&"
      "[ \"$PWD\" = \"$VINEBENCH_OUTPUT\" ] && : >out.txt");
  EXPECT_TRUE(fs::exists(folder_ / "recording/mav0/cam2/data/0000000002000000000.png"));
  EXPECT_TRUE(fs::exists(folder_ / "recording/rig.yaml"));
  EXPECT_FALSE(fs::exists(folder_ / "recording/mav0/state_groundtruth_estimate0"));
  EXPECT_EQ(run(": >out.txt").report.results.coverage, 0);  // replaces the previous recording
}

// The truth of the left camera: the body's circle and the camera's position on it.
TEST_F(ExternalSlamTest, PosesOfACameraAreJudgedAsTheBodys) {
  config_.poses_of = "front_left";
  std::string poses;
  for (int i = 0; i < 21; ++i) {
    const Stamp stamp = stamp_of_frame(i, test::kFakeRate);
    const Pose T_world_cam = test::circle(stamp) * notes().rig.make().cameras[0].T_body_cam;
    poses += format_tum({{stamp, T_world_cam}});
  }
  folder_.write("poses.tum", poses);
  const RunOutcome outcome = run("cp ../poses.tum trajectory.txt");
  EXPECT_EQ(outcome.report.results.coverage, 1);
  EXPECT_NEAR(outcome.report.results.corrected.value().origin.rmse, 0, 1e-8);  // m, of nine digits
}

TEST_F(ExternalSlamTest, LinksInTheFoldersPlacesAreErrors) {
  config_.program = "/bin/sh";
  fs::create_directories(folder_ / "theirs");
  for (const char* name : {"external", "recording"}) {
    fs::create_directory_symlink(folder_ / "theirs", folder_ / name);
    EXPECT_THAT(refusal(), HasSubstr(std::string(name) + ": is a link"));
    EXPECT_TRUE(fs::is_empty(folder_ / "theirs"));
    fs::remove(folder_ / name);
  }
}

TEST_F(ExternalSlamTest, WhatGoesWrongInItIsTheVerdict) {
  EXPECT_THAT(
      failure("echo no vocabulary >&2; exit 3"),
      testing::AllOf(HasSubstr("slam.sh: exit code 3"), HasSubstr("log.txt: no vocabulary")));
  EXPECT_THAT(failure("kill -SEGV $$"),
              HasSubstr("slam.sh: ended by signal 11 (Segmentation fault); it printed nothing"));
  EXPECT_THAT(failure(":"), HasSubstr("wrote no trajectory; expected "));
  EXPECT_THAT(failure("echo 1 2 3 >trajectory.txt"), HasSubstr("trajectory.txt:1: expected 8"));
  EXPECT_TRUE(fs::exists(folder_ / "metrics.json"));
  EXPECT_TRUE(fs::exists(folder_ / "recording/frames.csv"));  // to look for the cause
}

TEST_F(ExternalSlamTest, ItsLimitsAreThoseOfTheConfiguration) {
  config_.memory_mib = 100;
  EXPECT_THAT(failure("head -c 300M /dev/zero | tail -c 300M | sleep 60"),
              HasSubstr("used more than 100 MiB of memory"));
  config_.timeout = 0.1;
  EXPECT_THAT(failure("sleep 60"), HasSubstr("took more than 0.1 s"));
}

TEST_F(ExternalSlamTest, TheProgramEndsWithABenchThatIsKilled) {
  const std::vector<pid_t> left =
      test::kill_when_listed(folder_ / "external/pid", 1, [&] { run("echo $$ >pid; sleep 60"); });
  EXPECT_EQ(left.size(), 1u);
  EXPECT_TRUE(test::end_soon(left));
}

// Before anything is recorded.
TEST_F(ExternalSlamTest, AnUnusableConfigurationIsAnError) {
  config_.program = folder_.write("readme.txt", "not a program");
  EXPECT_THAT(refusal(), HasSubstr("readme.txt: cannot be started: Permission denied"));
  config_.poses_of = "top";
  EXPECT_THAT(refusal(), HasSubstr("poses_of: expected 'body' or a camera of the rig"));
  EXPECT_FALSE(fs::exists(folder_ / "recording"));
}

TEST_F(ExternalSlamTest, TheTrajectoryMustLieInTheOutputFolder) {
  for (const char* outside :
       {"/home/anne/poses.txt", "../poses.txt", "a/../../poses.txt", "..", ".", "a/"}) {
    config_.trajectory = outside;
    EXPECT_THAT(test::error_of([&] { validate(config_); }),
                HasSubstr("trajectory: expected a file in the program's output folder"))
        << outside;
  }
  config_.trajectory = "results/poses..txt";
  config_.program = "slam.sh";
  EXPECT_NO_THROW(validate(config_));
}

// A link that an earlier run left would otherwise lead to the file's removal.
TEST_F(ExternalSlamTest, LinksMustNotLeadOutOfTheOutputFolder) {
  config_.program = "/bin/sh";
  const fs::path precious = folder_.write("poses.txt", "precious");
  fs::create_directories(folder_ / "external");
  fs::create_directory_symlink("..", folder_ / "external/results");
  config_.trajectory = "results/poses.txt";
  EXPECT_THAT(refusal(), HasSubstr("external/results leads out of "));
  EXPECT_TRUE(fs::exists(precious));

  fs::rename(folder_ / "external", folder_ / "other");
  fs::create_directory_symlink("other", folder_ / "external");
  config_.trajectory = "trajectory.txt";
  EXPECT_THAT(refusal(), HasSubstr("external: is a link"));

  fs::remove(folder_ / "external");
  EXPECT_THAT(failure("ln -s ../poses.txt trajectory.txt"),
              HasSubstr("external/trajectory.txt leads out of "));
}

TEST_F(ExternalSlamTest, AStopEndsTheProgram) {
  stopped_ = [&] { return fs::exists(folder_ / "external/started"); };
  const RunOutcome outcome = run(": >started; sleep 60");
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_FALSE(fs::exists(folder_ / "metrics.json"));
}

}  // namespace
}  // namespace vinebench::harness
