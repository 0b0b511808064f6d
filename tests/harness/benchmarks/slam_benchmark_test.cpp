// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/benchmarks/slam_benchmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/test_folder.h"
#include "tests/support/wall.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

/// Nine frames of the wall, of which seven are measured.
SlamBenchmark wall_benchmark() {
  test::wall::Source source;
  SlamBenchmark benchmark;
  benchmark.name = "wall";
  benchmark.rig = source.rig();
  benchmark.warm_up = 2;
  benchmark.frames = preload(source, 9);
  return benchmark;
}

/// A coloured image of one colour after the other.
class ColourSource : public test::wall::Source {
 public:
  std::optional<Sample> next() override {
    std::optional<Sample> sample = Source::next();
    if (sample) sample->frame.images[0] = cv::Mat(4, 4, CV_8UC3, cv::Scalar(255, 0, 0));
    return sample;
  }
};

TEST(PreloadTest, FramesAreGreyAndEndWithTheSource) {
  ColourSource source;
  const std::vector<Frame> frames = preload(source, 100);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(test::wall::kFrames));
  EXPECT_EQ(frames[0].images[0].type(), CV_8UC1);
  EXPECT_EQ(frames[0].images[0].at<std::uint8_t>(0, 0),
            76);  // 0.299 * 255 of red, the first of RGB
  EXPECT_EQ(frames[11].index, 11);
}

TEST(SlamBenchmarkTest, MeasuresFramesInMemory) {
  const auto result = measure_slam(wall_benchmark());
  EXPECT_EQ(result["frames"], 7);
  ASSERT_EQ(result["runs"].size(), 1u);  // one pair and no tag camera
  const auto& run = result["runs"][0];
  EXPECT_EQ(run["tracked"], 1);
  EXPECT_GT(run["cpu_ms"]["mean"], 0);
  EXPECT_EQ(run["cpu_ms_by_quarter"].size(), 4u);
  EXPECT_GE(run["wall_ms"]["p95"], run["wall_ms"]["p50"]);
  EXPECT_GE(run["wall_ms"]["max"], run["wall_ms"]["p95"]);
  EXPECT_TRUE(run["stages_ms"].contains("tracking"));
  EXPECT_GT(result["orb_cpu_ms"]["p50"], 0);
  EXPECT_FALSE(result.contains("tags_cpu_ms"));
  EXPECT_THAT(slam_table(result), testing::AllOf(HasSubstr("wall: 7 frames"), HasSubstr("ORB")));
}

TEST(SlamBenchmarkTest, TagCamerasAreMeasuredApart) {
  SlamBenchmark benchmark = wall_benchmark();
  benchmark.frames.resize(4);
  benchmark.rig.tag_cameras = {0};
  const auto result = measure_slam(benchmark);
  ASSERT_EQ(result["runs"].size(), 2u);
  EXPECT_EQ(result["runs"][0]["cameras"], "all cameras");
  EXPECT_EQ(result["runs"][1]["cameras"], "stereo pairs");
  EXPECT_GT(result["tags_cpu_ms"]["p50"], 0);
  EXPECT_THAT(slam_table(result), HasSubstr("tag search"));
}

TEST(SlamBenchmarkTest, TooFewFramesAreAnError) {
  SlamBenchmark benchmark = wall_benchmark();
  benchmark.warm_up = 9;
  EXPECT_THAT(test::error_of([&] { measure_slam(benchmark); }),
              HasSubstr("expected more than 9 frames"));
}

}  // namespace
}  // namespace vinebench::harness
