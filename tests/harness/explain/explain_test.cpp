// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/explain.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "harness/explain/run_to_explain.h"
#include "harness/jobs/run_scenario.h"
#include "tests/support/court_scenario.h"

namespace vinebench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

StretchDrift drift_and_losses(double metres, double lost = 0) {
  return {.metres = metres, .end = metres, .lost = lost};
}

/// 20 mm, of which removals leave what is given; factors 0, 1, 2.
class CausesTest : public testing::Test {
 protected:
  CausesTest() {
    look_.normal.chance = as_it_was(
        {drift_and_losses(0.02, 10), drift_and_losses(0.0205, 10), drift_and_losses(0.0195, 10)});
  }

  void singles(const std::vector<StretchDrift>& rests) {
    for (std::size_t i = 0; i < rests.size(); ++i) {
      FactorEffect one{.factors = {i}, .reruns = {rests[i]}};
      one.effect = effect_of(look_.normal.chance, one.reruns);
      look_.singles.push_back(one);
    }
  }

  Look look_;
};

TEST_F(CausesTest, TheStrongestFirst) {
  singles({drift_and_losses(0.006, 10), drift_and_losses(0.02, 10), drift_and_losses(0.003, 10)});
  EXPECT_THAT(causes_of(look_), ElementsAre(2, 0));
}

TEST_F(CausesTest, LostFramesCountByTheirShare) {
  singles({drift_and_losses(0.006, 10), drift_and_losses(0.02, 0)});
  EXPECT_THAT(causes_of(look_), ElementsAre(1, 0));  // all of the losses, 70 % of the drift
}

TEST_F(CausesTest, OfEqualLossesTheDriftDecides) {
  // Without either no frame is lost; without the second one the rest of the drive drifts less.
  singles({drift_and_losses(0.04, 0), drift_and_losses(0.022, 0)});
  EXPECT_THAT(causes_of(look_), ElementsAre(1, 0));
}

TEST_F(CausesTest, ThoseThatWouldDoAloneAreCauses) {
  singles({drift_and_losses(0.02, 10), drift_and_losses(0.02, 10), drift_and_losses(0.019, 10)});
  EXPECT_THAT(causes_of(look_), ElementsAre());
  look_.alone = {{.factors = {0}, .effect = {.metres = 0.005, .drift_is_caused = true}},
                 {.factors = {1}, .effect = {.metres = 0.003}},
                 {.factors = {2}, .effect = {.metres = 0.015, .drift_is_caused = true}}};
  EXPECT_THAT(causes_of(look_), ElementsAre(2, 0));
}

TEST_F(CausesTest, OfAStretchAreThoseOfTheFirstLookFirst) {
  StretchExplanation stretch;
  stretch.looks = {{.causes = {2, 1}}, {.causes = {0}}, {}};
  EXPECT_THAT(stretch.causes(), ElementsAre(2, 1, 0));
}

/// Ten frames along the court.
class ExplainTest : public test::CourtScenario {
 protected:
  static constexpr std::int64_t kLast = 9;

  ExplainTest() { write_large_rig(); }

  ScenarioConfig ten_frames() const {
    ScenarioConfig longer = scenario();
    longer.simulation.duration = 0.61;
    return longer;
  }

  /// Three of them without images.
  ScenarioConfig with_dropped_images() const {
    ScenarioConfig config = ten_frames();
    sim::FaultScope burst;
    burst.from = 0.25;
    burst.until = 0.45;
    config.simulation.sensors.drops.bursts = {burst};
    return config;
  }

  /// A turn of a second with the right camera 40 mm aside, and no images from 0.25 s to `until`.
  ScenarioConfig aside_without_images(double until) const {
    ScenarioConfig config = with_dropped_images();
    sim::CalibrationErrorConfig::Camera error;
    error.name = "right";
    error.position.y() = -0.04;
    config.simulation.sensors.calibration.cameras = {error};
    config.simulation.route.waypoints.back().heading_deg = 60;
    config.simulation.duration = 1.01;
    config.simulation.sensors.drops.bursts[0].until = until;
    return config;
  }

  static std::vector<std::string> names_of(const Explanation& explanation,
                                           const std::vector<std::size_t>& factors) {
    std::vector<std::string> names;
    for (const std::size_t i : factors) names.push_back(explanation.factors[i].name);
    return names;
  }

  ExplainRequest run(const ScenarioConfig& config, const StretchChoice& choice) const {
    RunOptions options;
    options.folder = folder_ / "out";
    const FolderLock lock = prepare_scenario_folder(options.folder, config);
    run_scenario(config, machine(), 1, options);
    ExplainRequest request = read_run(options.folder, choice);
    request.machine = machine();
    request.lead = 0.13;
    request.placebos = 2;
    request.repeats = 0;
    return request;
  }
};

// Three of ten frames have no images: the factors are noise, drops and slip, of which drops alone
// lose frames.
TEST_F(ExplainTest, DroppedImagesLoseFrames) {
  const ScenarioConfig config = with_dropped_images();
  const Explanation explanation = explain(run(config, {.number = {}, .from = 0.2, .to = {}}));
  ASSERT_EQ(explanation.stretches.size(), 1u);
  const StretchExplanation& stretch = explanation.stretches[0];
  EXPECT_EQ(stretch.stretch.first, 3);
  EXPECT_EQ(stretch.stretch.last, kLast);
  EXPECT_EQ(stretch.aligned, 0);  // 0.13 s before frame 3 is frame 1: the last one as it was is 0
  EXPECT_GE(stretch.was.lost, 3);
  ASSERT_FALSE(stretch.causes().empty());
  EXPECT_EQ(explanation.factors[stretch.causes()[0]].name, "drops");
  for (const FactorEffect& one : stretch.looks[0].singles) {
    const bool drops = explanation.factors[one.factors[0]].name == "drops";
    EXPECT_EQ(one.effect.losses_are_caused, drops);
  }
  // As it was, two placebos, three factors, all of them: at least.
  EXPECT_GE(explanation.reruns, 7);
}

// With the right camera 40 of 120 mm aside no frame of a turn is tracked. Where it is as the rig
// says, those without images are lost.
TEST_F(ExplainTest, FindsWhatAStrongerCauseHides) {
  ExplainRequest request = run(aside_without_images(0.51), {.number = {}, .from = 0.3, .to = {}});
  request.pairs = 0;
  const Explanation explanation = explain(request);
  const StretchExplanation& stretch = explanation.stretches.at(0);
  EXPECT_EQ(stretch.was.lost, 11);  // frames 5 to 15
  EXPECT_THAT(names_of(explanation, stretch.causes()), ElementsAre("calibration", "drops"));
  ASSERT_GE(stretch.looks.size(), 2u);
  const Look& rest = stretch.looks[1];
  EXPECT_THAT(names_of(explanation, rest.normal.without), ElementsAre("calibration"));
  EXPECT_THAT(names_of(explanation, rest.causes), ElementsAre("drops"));
  EXPECT_EQ(rest.normal.drifts.size(), 3u);  // one rerun, two placebos
  // Each other factor was tried once more.
  EXPECT_EQ(rest.singles.size() + 1, explanation.factors.size());
}

// The same without images in all of the stretch: either would lose all of its frames.
TEST_F(ExplainTest, NamesBothOfTwoThatWouldEachDo) {
  ExplainRequest request = run(aside_without_images(1.02), {.number = {}, .from = 0.3, .to = {}});
  request.pairs = 0;
  const Explanation explanation = explain(request);
  const StretchExplanation& stretch = explanation.stretches.at(0);
  EXPECT_EQ(stretch.was.lost, 11);
  const Look& look = stretch.looks.at(0);
  for (const FactorEffect& single : look.singles) EXPECT_FALSE(single.effect.is_cause());
  ASSERT_EQ(look.alone.size(), explanation.factors.size());
  EXPECT_THAT(names_of(explanation, look.causes), UnorderedElementsAre("calibration", "drops"));
}

TEST_F(ExplainTest, RefusesARunThatItCannotRepeat) {
  ExplainRequest request = run(ten_frames(), {});
  EXPECT_EQ(test::error_of([&] { explain(request); }), "");
  ExplainRequest other = request;
  other.scenario.seed = 6;
  EXPECT_THAT(test::error_of([&] { explain(other); }), HasSubstr("cannot be repeated here"));
  other.stretches[0].first = 6;  // the frames before it are checked too
  EXPECT_THAT(test::error_of([&] { explain(other); }), HasSubstr("cannot be repeated here"));
}

TEST_F(ExplainTest, RefusesWhatItCannotExplain) {
  ExplainRequest request{
      .scenario = ten_frames(), .live_poses = {}, .stretches = {{.last = 3}}, .machine = machine()};
  request.scenario.simulation.route.steering = sim::Steering::kEstimate;
  EXPECT_THAT(test::error_of([&] { explain(request); }), HasSubstr("steering: truth"));
  request.scenario.slam.external.emplace();
  EXPECT_THAT(test::error_of([&] { explain(request); }), HasSubstr("built-in SLAM core"));
  request.scenario = ten_frames();
  request.placebos = 1;
  EXPECT_THAT(test::error_of([&] { explain(request); }), HasSubstr("at least two placebos"));
}

}  // namespace
}  // namespace vinebench::harness
