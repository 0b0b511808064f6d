// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "core/util/error.h"
#include "core/util/files.h"
#include "harness/report/run_folder.h"
#include "tests/support/fakes.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

class RunTest : public testing::Test {
 protected:
  RunOutcome run(test::FakeSlam::Change change = {}, int seed = 1) {
    test::FakeSource source(seed);
    test::FakeSlam slam(std::move(change));
    RunOptions options;
    options.stopped = stopped_;
    if (!folder_.empty() && fs::exists(folder_)) options.folder = folder_;
    return run_lockstep_and_judge(test::fake_trial(), source, slam, options);
  }
  std::string text_of(const char* name) const { return read_file(folder_ / name); }
  std::vector<Json> events() const {
    std::istringstream in(text_of("events.jsonl"));
    std::vector<Json> list;
    for (std::string line; std::getline(in, line);) list.push_back(Json::parse(line));
    return list;
  }

  test::TestFolder tests_;
  const fs::path folder_ = tests_ / "run";
  std::function<bool()> stopped_;
};

void close_loop(Estimate& estimate) {
  if (estimate.stamp != test::seconds(19)) return;
  estimate.loop_closure = test::fake_closure(test::seconds(1), test::seconds(19));
  estimate.loop_closure->correction = 0.05;
}

TEST_F(RunTest, WritesEveryFile) {
  test::prepare_fake_folder(folder_);
  const RunOutcome outcome = run(close_loop);
  EXPECT_FALSE(outcome.interrupted);
  EXPECT_EQ(read_tum(folder_ / "groundtruth.tum").size(), 201u);
  EXPECT_EQ(read_tum(folder_ / "estimate.tum").size(), 201u);
  EXPECT_EQ(read_tum(folder_ / "estimate_live.tum").size(), 201u);
  EXPECT_EQ(read_tum(folder_ / "keyframes.tum").size(), 5u);  // frames 0, 50, 100, 150, 200
  EXPECT_THAT(text_of("scenario.resolved.yaml"), testing::HasSubstr("name: \"fake\""));
  EXPECT_THAT(text_of("plot.svg"), testing::StartsWith("<svg"));
  EXPECT_EQ(Json::parse(text_of("metrics.json")), outcome.metrics);
}

TEST_F(RunTest, MetricsHaveEveryKey) {
  const RunOutcome outcome = run(close_loop);
  for (const char* key : {"scenario",
                          "seed",
                          "version",
                          "frames",
                          "coverage",
                          "lost_frames",
                          "losses",
                          "ate_rmse_m",
                          "ate_max_m",
                          "ate_live_rmse_m",
                          "ate_origin_rmse_m",
                          "rpe_trans_percent",
                          "loop_closures",
                          "keyframes",
                          "landmarks",
                          "features",
                          "inliers",
                          "real_time_factor",
                          "wall_seconds",
                          "timing_ms",
                          "peak_rss_mib",
                          "hash"}) {
    EXPECT_TRUE(outcome.metrics.contains(key)) << key;
  }
  EXPECT_EQ(outcome.metrics["frames"], 201);
  EXPECT_EQ(outcome.metrics["landmarks"], 1234);
  EXPECT_EQ(outcome.metrics["features"]["front_left"], 500);
  EXPECT_EQ(outcome.metrics["inliers"]["front_right"], 80);
  EXPECT_EQ(outcome.metrics["loop_closures"], Json({{"correct", 1}, {"wrong", 0}, {"missed", 0}}));
}

TEST_F(RunTest, ImagesAreThoseOfTheSource) {
  test::prepare_fake_folder(folder_);
  run();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "frames"), {}), 12 * 3);
  const cv::Mat bgr = cv::imread((folder_ / "frames/000200_side.png").string());
  ASSERT_FALSE(bgr.empty());
  EXPECT_EQ(bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(200, 2, 1));  // blue frame, green camera, red seed
}

TEST_F(RunTest, ImagesAreLeftAsTheyAreForOtherSinks) {
  struct FirstPixels : Sink {
    void on_tick(const Sample& sample, const Estimate&) override {
      seen.push_back(sample.frame.images[0].at<cv::Vec3b>(0, 0));
    }
    std::vector<cv::Vec3b> seen;
  } pixels;
  test::prepare_fake_folder(folder_);
  test::FakeSource source(7, 3);
  test::FakeSlam slam;
  RunOptions options;
  options.folder = folder_;
  options.sinks = {&pixels};
  run_lockstep_and_judge(test::fake_trial(), source, slam, options);
  ASSERT_EQ(pixels.seen.size(), 3u);
  EXPECT_EQ(pixels.seen[2], cv::Vec3b(7, 0, 2));  // red seed, green camera, blue frame
}

TEST_F(RunTest, EventsTellTheStory) {
  test::prepare_fake_folder(folder_);
  run([](Estimate& estimate) {
    close_loop(estimate);
    const double t = to_seconds(estimate.stamp);
    if (t >= 9 && t <= 10) {
      estimate.status = t <= 9.5 ? TrackingStatus::kDeadReckoning : TrackingStatus::kLost;
      estimate.T_map_body.reset();
      estimate.keyframe = false;
    }
    // Ambiguous for a second, accepted for one, and misplaced for half a second.
    if (t < 1) estimate.rejected_tags = {{"tag36h11", 7, 2, TagRejection::kAmbiguous}};
    if (t >= 2 && t < 2.5) estimate.rejected_tags = {{"tag36h11", 7, 2, TagRejection::kMisplaced}};
    if (t <= 2)
      estimate.tags = {
          {.camera = 2, .family = "tag36h11", .id = 7, .corners = {}, .T_cam_tag = {}}};
  });
  std::map<std::string, int> counts;
  double last = 0;
  for (const Json& event : events()) {
    ++counts[event["event"]];
    EXPECT_GE(event["t"], last);
    last = event["t"];
    if (event["event"] == "occlusion_end") {
      EXPECT_DOUBLE_EQ(event["seconds"], 4.1);
    }
    if (event["event"] == "loop_closure") {
      EXPECT_TRUE(event["correct"]);
    }
    if (event["event"] == "tag_gone") {
      EXPECT_EQ(event["frames"], 21);
    }
    if (event["event"] == "lost") {
      EXPECT_TRUE(event["dead_reckoning"]);
    }
    if (event["event"] == "explained") {  // lost behind the carton
      EXPECT_EQ(event["cause"], "occlusion");
      EXPECT_EQ(event["from"], 9);
      EXPECT_EQ(event["until"], 10);
    }
    if (event["event"] == "tag_rejected") {
      EXPECT_EQ(event["reason"], event["frame"] == 0 ? "ambiguous" : "misplaced");
    }
  }
  const std::map<std::string, int> expected{{"initialised", 1},
                                            {"keyframe", 4},
                                            {"loop_closure", 1},
                                            {"lost", 1},
                                            {"relocalised", 1},
                                            {"occlusion_begin", 2},
                                            {"tag_gone", 1},
                                            {"occlusion_end", 2},
                                            {"tag_seen", 1},
                                            {"tag_rejected", 2},
                                            {"dead_reckoning_given_up", 1},
                                            {"explained", 1}};
  EXPECT_EQ(counts, expected);
}

TEST_F(RunTest, TheHashSeesEveryPixelAndEstimate) {
  const std::string hash = run().hash;
  EXPECT_EQ(hash.size(), 32u);
  EXPECT_EQ(run().hash, hash);
  EXPECT_NE(run({}, 2).hash, hash);  // other images
  EXPECT_NE(run(close_loop).hash, hash);
  EXPECT_NE(run([](Estimate& estimate) {
              if (estimate.stamp == test::seconds(5)) {
                estimate.T_map_body->translation.x() += 1e-15;
              }
            }).hash,
            hash);
}

TEST_F(RunTest, AnInterruptedRunKeepsWhatItHas) {
  test::prepare_fake_folder(folder_);
  run();
  int asked = 0;
  stopped_ = [&] { return ++asked > 20; };
  test::prepare_fake_folder(folder_);
  const RunOutcome outcome = run();
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_EQ(outcome.frames, 20);
  EXPECT_EQ(read_tum(folder_ / "groundtruth.tum").size(), 20u);
  EXPECT_FALSE(fs::exists(folder_ / "metrics.json"));  // also removed from an earlier run
}

TEST_F(RunTest, ARunWithoutAnyPoseIsJudged) {
  test::prepare_fake_folder(folder_);
  const RunOutcome outcome = run([](Estimate& estimate) {
    estimate.T_map_body.reset();
    estimate.status = TrackingStatus::kInitializing;
    estimate.keyframe = false;
  });
  EXPECT_EQ(outcome.metrics["coverage"], 0);
  EXPECT_TRUE(outcome.metrics["ate_rmse_m"].is_null());
  EXPECT_THAT(text_of("plot.svg"), testing::EndsWith("</svg>\n"));
}

TEST_F(RunTest, AFolderBelowAFileIsAnError) {
  write_file_atomically(folder_, "a file");
  EXPECT_THAT([&] { test::prepare_fake_folder(folder_ / "run"); },
              testing::ThrowsMessage<Error>(testing::AllOf(testing::HasSubstr("output folder"),
                                                           testing::HasSubstr("Not a directory"))));
}

TEST_F(RunTest, ProgressOnATerminalIsOneLineElsewhereMany) {
  const auto progress = [](bool terminal) {
    test::FakeSource source;
    test::FakeSlam slam;
    std::ostringstream out;
    RunOptions options;
    options.progress = &out;
    options.terminal = terminal;
    run_lockstep_and_judge(test::fake_trial(), source, slam, options);
    return out.str();
  };
  const std::string plain = progress(false);
  EXPECT_EQ(std::ranges::count(plain, '\n'), 21);  // 0 %, 5 %, …, 100 %
  EXPECT_THAT(plain, testing::Not(testing::HasSubstr("\r")));
  const std::string bar = progress(true);
  EXPECT_EQ(std::ranges::count(bar, '\n'), 1);
  EXPECT_THAT(bar, testing::HasSubstr("201/201"));
}

TEST(MetricsTest, PercentilesLieBetweenNeighbours) {
  EXPECT_DOUBLE_EQ(percentile({3, 1, 2}, 0.5), 2);
  EXPECT_DOUBLE_EQ(percentile({1, 2}, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(percentile({0, 10, 20, 30, 40}, 0.95), 38);  // place 3.8
  EXPECT_DOUBLE_EQ(percentile({7}, 0.95), 7);
}

}  // namespace
}  // namespace vinebench::harness
