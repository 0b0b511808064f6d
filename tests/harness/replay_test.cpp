// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/benchmarks/slam_benchmark.h"
#include "tests/support/recorded_folders.h"
#include "tests/support/synthetic_plane.h"

namespace vinebench::harness {
namespace {

using test::render_image;
using test::SyntheticTexture;

using test::error_of;
using testing::HasSubstr;

constexpr int kFrames = 12;
constexpr double kStep = 0.02;  // m to the right a frame

/// A textured wall 2 m in front of a pair with 0.1 m baseline that moves to its right, in KITTI
/// format: 200 px * 0.1 m / 2 m = 10 px of disparity, 2 px a frame.
class WallRecording {
 public:
  explicit WallRecording(const test::TestFolder& folder) : root_(folder / "wall") {
    std::string poses;
    for (int i = 0; i < kFrames; ++i) {
      const int moved = 2 * i;  // px: 0.02 m * 200 px / 2 m
      test::write_image(root_ / fmt::format("image_0/{:06}.png", i), view(moved));
      test::write_image(root_ / fmt::format("image_1/{:06}.png", i), view(moved + 10));
      poses += fmt::format("1 0 0 {} 0 1 0 0 0 0 1 0\n", kStep * i);
    }
    test::write_text(root_ / "poses.txt", poses);
    test::write_text(root_ / "calib.txt",
                     "P0: 200 0 159.5 0 0 200 99.5 0 0 0 1 0\n"
                     "P1: 200 0 159.5 -20 0 200 99.5 0 0 0 1 0\n");
  }
  const std::filesystem::path& root() const { return root_; }

 private:
  /// Shifts of one wide image by integer pixels, so that each view is exact.
  static cv::Mat view(int shift) {
    static const cv::Mat wall = render_image(320 + 2 * kFrames + 10, 200, SyntheticTexture(3));
    return wall.colRange(shift, shift + 320);
  }
  std::filesystem::path root_;
};

class ReplayTest : public testing::Test {
 protected:
  RunOutcome replay(const std::filesystem::path& out = {}, int threads = 2) {
    Recording recording = open_recording(wall_.root());
    const slam::SlamConfig slam = replay_settings(recording, "", {});
    RunOptions options;
    options.folder = out;
    if (!out.empty()) prepare_replay_folder(out, slam);
    return run_replay(std::move(recording), slam, threads, options);
  }

  test::TestFolder folder_;
  WallRecording wall_{folder_};
};

TEST_F(ReplayTest, FollowsARecordingAndWritesARunsFiles) {
  const RunOutcome outcome = replay(folder_ / "out");
  EXPECT_EQ(outcome.metrics["coverage"], 1);
  // Tolerance of tracking: a tenth of a pixel, 1 mm at 2 m.
  EXPECT_LT(outcome.metrics["ate_rmse_m"].get<double>(), 1e-3);
  EXPECT_LT(outcome.metrics["ate_origin_rmse_m"].get<double>(), 5e-3);
  EXPECT_FALSE(outcome.metrics.contains("input_faults"));
  const Trajectory truth = read_tum(folder_ / "out/groundtruth.tum");
  ASSERT_EQ(truth.size(), static_cast<std::size_t>(kFrames));
  // To the right of the camera is -y of the world that has the first body's axes.
  EXPECT_NEAR(truth.back().pose.translation.y(), -kStep * (kFrames - 1), 1e-9);
  EXPECT_EQ(read_tum(folder_ / "out/estimate.tum").size(), static_cast<std::size_t>(kFrames));
  for (const char* file : {"metrics.json", "events.jsonl", "plot.svg", "keyframes.tum",
                           "estimate_live.tum", "slam.resolved.yaml"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / file)) << file;
  }
  EXPECT_THAT(format_replay(outcome.metrics), HasSubstr("100.0 % of 12, lost 0 times"));
}

TEST_F(ReplayTest, ThreadsChangeNoByte) {
  EXPECT_EQ(replay({}, 1).hash, replay({}, 3).hash);
}

TEST_F(ReplayTest, WithoutTruthThereAreNoErrorsButAnEstimate) {
  std::filesystem::remove(wall_.root() / "poses.txt");
  const RunOutcome outcome = replay(folder_ / "out");
  EXPECT_EQ(outcome.metrics["coverage"], 1);
  EXPECT_TRUE(outcome.metrics["ate_rmse_m"].is_null());
  EXPECT_TRUE(read_tum(folder_ / "out/groundtruth.tum").empty());
  EXPECT_THAT(read_file(folder_ / "out/plot.svg"), HasSubstr("<polyline"));
  EXPECT_THAT(format_replay(outcome.metrics), HasSubstr("unknown"));
}

TEST_F(ReplayTest, FaultsAreCountedAndLogged) {
  test::write_text(wall_.root() / "image_1/000005.png", "not an image");
  const RunOutcome outcome = replay(folder_ / "out");
  EXPECT_EQ(outcome.metrics["input_faults"], Json({{"picture_unreadable", 1}}));
  const std::string events = read_file(folder_ / "out/events.jsonl");
  EXPECT_THAT(events,
              HasSubstr("\"frame\":5,\"event\":\"picture_unreadable\",\"sensor\":\"right\""));
  EXPECT_THAT(format_replay(outcome.metrics), HasSubstr("picture_unreadable (1 times)"));
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

TEST_F(ReplayTest, TheBenchmarkMeasuresFramesInMemory) {
  WorkerPool pool(1);
  Recording recording = open_recording(wall_.root());
  SlamBenchmark benchmark;
  benchmark.name = "wall";
  benchmark.rig = recording.rig;
  benchmark.warm_up = 2;
  DatasetReader reader(std::move(recording), pool);
  benchmark.frames = preload(reader, 9);
  ASSERT_EQ(benchmark.frames.size(), 9u);
  const auto result = measure_slam(benchmark);
  EXPECT_EQ(result["frames"], 7);
  ASSERT_EQ(result["runs"].size(), 1u);  // one pair and no tag camera
  const auto& run = result["runs"][0];
  EXPECT_EQ(run["tracked"], 1);
  EXPECT_GT(run["cpu_ms"]["mean"], 0);
  EXPECT_GE(run["wall_ms"]["p95"], run["wall_ms"]["p50"]);
  EXPECT_TRUE(run["stages_ms"].contains("tracking"));
  EXPECT_GT(result["orb_cpu_ms"]["p50"], 0);
  EXPECT_THAT(slam_table(result), testing::AllOf(HasSubstr("wall: 7 frames"), HasSubstr("ORB")));
  benchmark.warm_up = 9;
  EXPECT_THAT(error_of([&] { measure_slam(benchmark); }), HasSubstr("expected more than 9 frames"));
}

}  // namespace
}  // namespace vinebench::harness
