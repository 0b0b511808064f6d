// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/run_to_explain.h"

#include <gmock/gmock.h>

#include "harness/jobs/run_scenario.h"
#include "tests/support/court_scenario.h"

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// At 10 Hz: 4 to 6 s are the frames 40 to 60; a segment with two causes is one stretch.
TEST(DegradedStretchesTest, AreThoseOfTheEvents) {
  const std::vector<Stretch> stretches = degraded_stretches(
      R"({"t":1.0,"frame":10,"event":"keyframe"}
{"t":6.0,"frame":60,"event":"explained","from":4.0,"until":6.0,"cause":"occlusion","occluder":"carton"}
{"t":6.0,"frame":60,"event":"explained","from":4.0,"until":6.0,"cause":"motion blur"}
no JSON
{"t":9.0,"frame":90,"event":"explained","from":8.0,"until":9.0,"cause":"unexplained"}
)",
      10);
  ASSERT_EQ(stretches.size(), 2u);
  EXPECT_EQ(stretches[0].number, 1);
  EXPECT_EQ(stretches[0].first, 40);
  EXPECT_EQ(stretches[0].last, 60);
  EXPECT_THAT(stretches[0].coincide, ElementsAre("occlusion by carton", "motion blur"));
  EXPECT_EQ(stretches[1].number, 2);
  EXPECT_EQ(stretches[1].first, 80);
}

/// A run of six frames in folder "out", without a degraded segment.
class RunToExplainTest : public test::CourtScenario {
 protected:
  RunToExplainTest() {
    write_large_rig();
    RunOptions options;
    options.folder = out_;
    const FolderLock lock = prepare_scenario_folder(out_, scenario());
    run_scenario(scenario(), machine(), 1, options);
  }

  std::string error(const StretchChoice& choice) const {
    return test::error_of([&] { read_run(out_, choice); });
  }

  const std::filesystem::path out_ = folder_ / "out";
};

TEST_F(RunToExplainTest, WithoutADegradedSegmentItIsTheWholeDrive) {
  const ExplainRequest request = read_run(out_, {});
  EXPECT_EQ(request.scenario.name, "court");
  EXPECT_EQ(request.scenario.seed, 5);
  EXPECT_EQ(request.differences, "");
  EXPECT_THAT(request.live_poses, HasSubstr("0.333333333 "));
  ASSERT_EQ(request.stretches.size(), 1u);
  EXPECT_EQ(request.stretches[0].first, 0);
  EXPECT_EQ(request.stretches[0].last, kFrames - 1);
}

// 0.13 s and 0.2 s are frames 2 and 3 at 15 Hz.
TEST_F(RunToExplainTest, AStretchMayBeGivenInSeconds) {
  const ExplainRequest request = read_run(out_, {.number = {}, .from = 0.13, .to = 0.2});
  EXPECT_EQ(request.stretches.at(0).first, 2);
  EXPECT_EQ(request.stretches.at(0).last, 3);
  EXPECT_EQ(read_run(out_, {.number = {}, .from = 0.13, .to = 9}).stretches.at(0).last,
            kFrames - 1);
}

TEST_F(RunToExplainTest, ChoicesThatDoNotFitAreErrors) {
  EXPECT_THAT(error({.number = 2, .from = {}, .to = {}}),
              HasSubstr("--stretch 2: the run has 0 degraded segments"));
  EXPECT_THAT(error({.number = {}, .from = 1, .to = 2}),
              HasSubstr("expected a part of the run's 0.33 s"));
  std::filesystem::remove(out_ / "metrics.json");
  EXPECT_THAT(error({}), HasSubstr("expected the folder of a complete run"));
}

}  // namespace
}  // namespace vinebench::harness
