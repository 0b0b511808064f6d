// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/report/stored_run.h"
#include "tests/support/recorded_folders.h"
#include "tests/support/wall.h"

namespace vinebench::harness {
namespace {

namespace wall = test::wall;

using test::error_of;
using testing::HasSubstr;

/// The wall of tests/support/wall.h in KITTI format.
class WallRecording {
 public:
  explicit WallRecording(const test::TestFolder& folder) : root_(folder / "wall") {
    std::string poses;
    for (int i = 0; i < wall::kFrames; ++i) {
      test::write_image(root_ / fmt::format("image_0/{:06}.png", i), wall::left_image(i));
      test::write_image(root_ / fmt::format("image_1/{:06}.png", i), wall::right_image(i));
      poses += fmt::format("1 0 0 {} 0 1 0 0 0 0 1 0\n", wall::kStep * i);
    }
    test::write_text(root_ / "poses.txt", poses);
    test::write_text(root_ / "calib.txt",
                     "P0: 200 0 159.5 0 0 200 99.5 0 0 0 1 0\n"
                     "P1: 200 0 159.5 -20 0 200 99.5 0 0 0 1 0\n");
  }
  const std::filesystem::path& root() const { return root_; }

 private:
  std::filesystem::path root_;
};

class ReplayTest : public testing::Test {
 protected:
  RunOutcome replay(const std::filesystem::path& out = {}, int threads = 2) {
    Recording recording = open_recording(wall_.root());
    const slam::SlamConfig slam = replay_settings(recording, "", {});
    RunOptions options;
    options.folder = out;
    std::optional<FolderLock> lock;
    if (!out.empty()) lock.emplace(prepare_replay_folder(out, {slam}));
    return run_replay(std::move(recording), slam, threads, options);
  }

  test::TestFolder folder_;
  WallRecording wall_{folder_};
};

TEST_F(ReplayTest, FollowsARecordingAndWritesARunsFiles) {
  const RunOutcome outcome = replay(folder_ / "out");
  EXPECT_EQ(outcome.report.results.coverage, 1);
  // Tolerance of tracking: a tenth of a pixel, 1 mm at 2 m.
  EXPECT_LT(outcome.report.results.corrected.value().ate.rmse, 1e-3);
  EXPECT_LT(outcome.report.results.corrected.value().origin.rmse, 5e-3);
  EXPECT_TRUE(outcome.report.input_faults.empty());
  const Trajectory truth = read_tum(folder_ / "out/groundtruth.tum");
  ASSERT_EQ(truth.size(), static_cast<std::size_t>(wall::kFrames));
  // To the right of the camera is -y of the world that has the first body's axes.
  EXPECT_NEAR(truth.back().pose.translation.y(), -wall::kStep * (wall::kFrames - 1), 1e-9);
  EXPECT_EQ(read_tum(folder_ / "out/estimate.tum").size(), static_cast<std::size_t>(wall::kFrames));
  for (const char* file : {"metrics.json", "events.jsonl", "plot.svg", "keyframes.tum",
                           "estimate_live.tum", "slam.resolved.yaml"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / file)) << file;
  }
  EXPECT_THAT(format_replay(outcome.report), HasSubstr("100.0 % of 12, lost 0 times"));
}

TEST_F(ReplayTest, ThreadsChangeNoByte) {
  EXPECT_EQ(replay({}, 1).report.hash, replay({}, 3).report.hash);
}

TEST_F(ReplayTest, WithoutTruthThereAreNoErrorsButAnEstimate) {
  std::filesystem::remove(wall_.root() / "poses.txt");
  const RunOutcome outcome = replay(folder_ / "out");
  EXPECT_EQ(outcome.report.results.coverage, 1);
  EXPECT_FALSE(outcome.report.results.corrected);
  EXPECT_TRUE(read_tum(folder_ / "out/groundtruth.tum").empty());
  EXPECT_THAT(read_file(folder_ / "out/plot.svg"), HasSubstr("<polyline"));
  EXPECT_THAT(format_replay(outcome.report), HasSubstr("unknown"));
}

TEST_F(ReplayTest, FaultsAreCountedAndLogged) {
  test::write_text(wall_.root() / "image_1/000005.png", "not an image");
  const RunOutcome outcome = replay(folder_ / "out");
  ASSERT_EQ(outcome.report.input_faults.size(), 1u);
  EXPECT_EQ(outcome.report.input_faults[0].kind, "picture_unreadable");
  EXPECT_EQ(outcome.report.input_faults[0].count, 1);
  const std::string events = read_file(folder_ / "out/events.jsonl");
  EXPECT_THAT(events,
              HasSubstr("\"frame\":5,\"event\":\"picture_unreadable\",\"sensor\":\"right\""));
  EXPECT_THAT(format_replay(outcome.report), HasSubstr("picture_unreadable (1 times)"));
}

// JSON cannot hold other bytes; the finished run matters more than its name.
TEST_F(ReplayTest, NamesThatAreNotUtf8LoseNoRun) {
  Recording recording = open_recording(wall_.root());
  recording.name = "wall\xff";
  recording.frames[5].images[1] = wall_.root() / "image_1/\xff.png";
  const slam::SlamConfig slam = replay_settings(recording, "", {});
  RunOptions options;
  options.folder = folder_ / "out\xff";
  const FolderLock lock = prepare_replay_folder(options.folder, {slam});
  const RunOutcome outcome = run_replay(std::move(recording), slam, 2, options);
  EXPECT_EQ(outcome.report.hash.size(), 32u);
  const auto stored = read_stored_run(options.folder / "metrics.json");
  ASSERT_TRUE(stored);
  EXPECT_EQ(stored->scenario, "wall\xef\xbf\xbd");
  EXPECT_THAT(read_file(options.folder / "events.jsonl"), HasSubstr("\xef\xbf\xbd.png"));
}

// A pose at the origin for every frame but the first; the wall moves, so that it is off.
TEST_F(ReplayTest, AProgramGetsTheFramesWithoutTheTruth) {
  Recording recording = open_recording(wall_.root());
  SlamChoice choice;
  choice.external.emplace().program = folder_.write(
      "slam.sh",
      "#!/bin/sh\nls \"$1/mav0\" >\"$2/given\"\nls \"$1/mav0/cam1/data\" | wc -l >\"$2/count\"\n"
      "tail -n +3 \"$1/frames.csv\" | sed 's/$/ 0 0 0 0 0 0 1/' >\"$2/trajectory.txt\"\n");
  std::filesystem::permissions(choice.external->program, std::filesystem::perms::owner_all);
  RunOptions options;
  options.folder = folder_ / "out";
  const FolderLock lock = prepare_replay_folder(options.folder, choice);
  const RunOutcome outcome = run_replay(std::move(recording), choice, 2, options, {});
  EXPECT_DOUBLE_EQ(outcome.report.results.coverage, 1.0 * (wall::kFrames - 1) / wall::kFrames);
  EXPECT_GT(outcome.report.results.corrected.value().origin.rmse, wall::kStep);
  EXPECT_EQ(read_file(folder_ / "out/external/given"), "body.yaml\ncam0\ncam1\nimu0\nwheels0\n");
  EXPECT_EQ(std::stoi(read_file(folder_ / "out/external/count")), wall::kFrames);
}

TEST_F(ReplayTest, AProgramThatFailsIsTold) {
  SlamChoice choice;
  choice.external.emplace().program = "/bin/false";
  const RunOutcome outcome = run_replay(open_recording(wall_.root()), choice, 2, {}, {});
  ASSERT_TRUE(outcome.report.failure);
  EXPECT_THAT(format_replay(outcome.report), HasSubstr("FAILED: /bin/false: exit code 1"));
}

TEST_F(ReplayTest, OtherSystemsHaveNoMaps) {
  SlamChoice choice;
  choice.external.emplace().program = "/bin/false";
  RunOptions options;
  options.maps.save = folder_ / "map";
  EXPECT_THAT(error_of([&] { run_replay(open_recording(wall_.root()), choice, 2, options, {}); }),
              HasSubstr("require the built-in SLAM core"));
}

TEST_F(ReplayTest, ARecordingsOwnSettingsNameNoProgram) {
  Recording recording = open_recording(wall_.root());
  recording.settings = folder_.write("slam.yaml", "external: {program: /bin/true}\n");
  EXPECT_THAT(error_of([&] { replay_choice(recording, "", {}); }), HasSubstr("unknown key"));
  // Named by the user, the same file may.
  EXPECT_TRUE(replay_choice(recording, recording.settings, {}).external);
  recording.settings.clear();
  const SlamChoice choice = replay_choice(recording, "", {{"slam.external.program", "/bin/true"}});
  EXPECT_EQ(choice.external.value().program, "/bin/true");
}

TEST_F(ReplayTest, SettingsComeFromFileAndOverrides) {
  const Recording recording = open_recording(wall_.root());
  const auto file = folder_.write("slam.yaml", "tracking: {radius: 12}\n");
  const slam::SlamConfig slam =
      replay_settings(recording, file, {{"slam.tracking.min_matches", "30"}});
  EXPECT_EQ(slam.tracking.radius, 12);
  EXPECT_EQ(slam.tracking.min_matches, 30);
  EXPECT_EQ(replay_settings(recording, "", {{"slam.cameras", "front"}}).cameras,
            std::vector<std::string>{"front"});
  const auto error = [&](const std::string& key, const std::string& value) {
    return error_of([&] { replay_settings(recording, "", {{key, value}}); });
  };
  EXPECT_THAT(error("slam.tracking.radios", "1"), HasSubstr("unknown key"));
  EXPECT_THAT(error("slam.tracking.radius", "-1"), HasSubstr("expected a number"));
  EXPECT_THAT(error("slam.features.fast_threshold", "5"), HasSubstr("at most fast_threshold"));
  EXPECT_THAT(error("world.sun", "1"), HasSubstr("expected a key of the SLAM core"));
  folder_.write("slam.yaml", "tracking: {radius: -1}\n");
  EXPECT_THAT(error_of([&] { replay_settings(recording, file, {}); }),
              HasSubstr("slam.yaml:1: tracking.radius"));
}

}  // namespace
}  // namespace vinebench::harness
