// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "core/files/files.h"
#include "core/util/error.h"
#include "harness/report/report_json.h"
#include "harness/report/run_folder.h"
#include "harness/run/system_failure.h"
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
  EXPECT_THAT(text_of("events.jsonl"), testing::HasSubstr("\"event\":\"loop_closure\""));
  EXPECT_EQ(Json::parse(text_of("metrics.json")), to_json(outcome.report));
}

// 201 frames at 10 Hz.
TEST_F(RunTest, ReportsWhatItTook) {
  const RunCost cost = run().report.cost;
  EXPECT_GT(cost.wall_seconds, 0);
  EXPECT_GT(cost.cpu_seconds, 0);
  EXPECT_DOUBLE_EQ(cost.real_time_factor, 20.1 / cost.wall_seconds);
  EXPECT_GT(cost.peak_rss_mib, 1);
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

TEST_F(RunTest, TheHashSeesEveryPixelAndEstimate) {
  const std::string hash = run().report.hash;
  EXPECT_EQ(hash.size(), 32u);
  EXPECT_EQ(run().report.hash, hash);
  EXPECT_NE(run({}, 2).report.hash, hash);  // other images
  EXPECT_NE(run(close_loop).report.hash, hash);
  EXPECT_NE(run([](Estimate& estimate) {
              if (estimate.stamp == test::seconds(5)) {
                estimate.T_map_body->translation.x() += 1e-15;
              }
            }).report.hash,
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
  EXPECT_EQ(outcome.report.frames, 20);
  EXPECT_EQ(read_tum(folder_ / "groundtruth.tum").size(), 20u);
  EXPECT_FALSE(fs::exists(folder_ / "metrics.json"));  // also removed from an earlier run
}

// Up to the frame before it, of which nothing is lost.
TEST_F(RunTest, AFailureOfTheSystemIsAVerdict) {
  test::prepare_fake_folder(folder_);
  const auto fail_at_5_s = [](Estimate& estimate) {
    if (estimate.stamp == test::seconds(5)) fail_system("out of ideas");
  };
  const RunOutcome outcome = run(fail_at_5_s);
  EXPECT_FALSE(outcome.interrupted);
  EXPECT_EQ(outcome.report.frames, 50);
  EXPECT_EQ(outcome.report.failure.value().cause, "out of ideas");
  EXPECT_EQ(outcome.report.failure->frame, 50);
  EXPECT_EQ(read_tum(folder_ / "estimate_live.tum").size(), 50u);
  EXPECT_EQ(Json::parse(text_of("metrics.json")), to_json(outcome.report));
}

// As by ^C, which may be what ended the system.
TEST_F(RunTest, AFailureWhileItIsStoppedIsAnInterruption) {
  bool stop = false;
  stopped_ = [&] { return stop; };
  const RunOutcome outcome = run([&](Estimate& estimate) {
    if (estimate.stamp == test::seconds(5)) {
      stop = true;
      fail_system("out of ideas");
    }
  });
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_FALSE(outcome.report.failure);
}

TEST_F(RunTest, ARunWithoutAnyPoseIsJudged) {
  test::prepare_fake_folder(folder_);
  const RunOutcome outcome = run([](Estimate& estimate) {
    estimate.T_map_body.reset();
    estimate.status = TrackingStatus::kInitializing;
    estimate.keyframe = false;
  });
  EXPECT_EQ(outcome.report.results.coverage, 0);
  EXPECT_FALSE(outcome.report.results.corrected);
  EXPECT_THAT(text_of("plot.svg"), testing::EndsWith("</svg>\n"));
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

}  // namespace
}  // namespace vinebench::harness
