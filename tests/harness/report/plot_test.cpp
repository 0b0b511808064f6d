// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/fakes.h"

namespace vinebench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string plot(const RunRecord& record, const Trial& trial) {
  return plot_svg(trial, record, measure(record, trial));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++times;
  }
  return times;
}

/// One metre to the east in eleven frames, without a site.
RunRecord straight() {
  RunRecord record;
  record.rig = test::fake_rig();
  for (std::int64_t i = 0; i <= 10; ++i) {
    Tick tick;
    tick.stamp = stamp_of_frame(i, test::kFakeRate);
    tick.truth.T_world_body.translation.x() = 0.1 * static_cast<double>(i);
    record.ticks.push_back(tick);
    record.summary.trajectory.push_back({tick.stamp, tick.truth.T_world_body});
  }
  return record;
}

// With a margin of 0.6 m the map is 2.2 m x 1.2 m, 1000 px wide: 454.5 px/m, 60 px from the edges.
// The start is at 60 + 0.6 * 454.55 in both axes, the end 454.55 to the right of it.
TEST(PlotTest, MetresBecomePixels) {
  const std::string svg = plot(straight(), {});
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"332.73\" cy=\"332.73\" r=\"5.00\""));
  EXPECT_THAT(svg, HasSubstr("<circle cx=\"787.27\" cy=\"332.73\" r=\"3.00\""));
  EXPECT_THAT(svg, HasSubstr("<clipPath id=\"map\"><rect x=\"60\" y=\"60\" width=\"1000.0\""));
}

TEST(PlotTest, NorthIsUp) {
  RunRecord record = straight();
  for (Tick& tick : record.ticks) {
    std::swap(tick.truth.T_world_body.translation.x(), tick.truth.T_world_body.translation.y());
  }
  // 1.2 m x 2.2 m in 700 px of height: 318.18 px/m; the end is at 60 + 0.6 * 318.18.
  EXPECT_THAT(plot(record, {}), HasSubstr("cy=\"250.91\" r=\"3.00\""));
}

// The last pose is 0.1 m aside. The alignment is a regression line: frame i of 0 to 10 is
// |1/11 + (i - 5) / 22| * 0.1 m off it, the last one (1 - 1/11 - 5/22) * 0.1 m. The lines to frames
// 1 to 5 are below a sixth of that, the scale's first colour; each colour is in the legend too.
TEST(PlotTest, TheEstimateIsColouredByItsError) {
  RunRecord record = straight();
  record.summary.trajectory.back().pose.translation.y() = 0.1;
  const std::string svg = plot(record, {});
  EXPECT_EQ(count(svg, "stroke=\"#fde725\" stroke-width=\"3\""), 1u + 1u);
  EXPECT_EQ(count(svg, "stroke=\"#440154\" stroke-width=\"3\""), 5u + 1u);
  EXPECT_THAT(svg, HasSubstr("estimate, error (mm)"));
}

TEST(PlotTest, AGapOfTheEstimateStaysOne) {
  const std::size_t whole = count(plot(straight(), {}), "stroke-width=\"3\"");
  RunRecord record = straight();
  auto& trajectory = record.summary.trajectory;
  trajectory.erase(trajectory.begin() + 4, trajectory.begin() + 7);  // four lines less
  EXPECT_EQ(count(plot(record, {}), "stroke-width=\"3\""), whole - 4);
}

TEST(PlotTest, ShowsTheSite) {
  const std::string svg = plot(test::record_of(), test::fake_trial());
  EXPECT_THAT(svg, AllOf(HasSubstr(">fake, seed 1: ATE 0.0 mm SE(3)-aligned"), HasSubstr(">tag 7<"),
                         HasSubstr(">vine row<"), HasSubstr(">carton<")));
  EXPECT_THAT(svg, Not(HasSubstr("cameras blind")));
  EXPECT_THAT(svg, Not(HasSubstr("loop closed")));
}

TEST(PlotTest, ShowsClosuresAndWhereCamerasWereBlind) {
  Trial trial = test::fake_trial();
  trial.expectations.blind = {.cameras = {"front_left"}, .inliers_drop = {}};
  const auto close = [](double offset) {
    return test::record_of([=](Estimate& estimate) {
      if (estimate.stamp != test::seconds(19)) return;
      estimate.loop_closure = test::fake_closure(test::seconds(1), test::seconds(19), offset);
    });
  };
  const char* correct = "r=\"9.00\" fill=\"none\" stroke-width=\"2.5\" stroke=\"#1f77b4\"";
  const char* wrong = "r=\"9.00\" fill=\"none\" stroke-width=\"2.5\" stroke=\"#d62728\"";
  const std::string good = plot(close(0), trial);
  EXPECT_EQ(count(good, correct), 1u);
  EXPECT_EQ(count(good, wrong), 0u);
  EXPECT_THAT(good, HasSubstr("truth, cameras blind"));
  EXPECT_EQ(count(plot(close(1), trial), wrong), 1u);
}

TEST(PlotTest, WithoutTruthTheEstimateStandsAlone) {
  RunRecord record = straight();
  for (Tick& tick : record.ticks) tick.truth.known = false;
  const std::string svg = plot(record, {});
  EXPECT_EQ(count(svg, "<polyline"), 1u);
  EXPECT_THAT(svg, Not(HasSubstr("error (mm)")));
}

TEST(PlotTest, NamesAreEscapedAndNothingIsStillADocument) {
  Trial trial;
  trial.name = "rows < 3 & more";
  const std::string svg = plot({}, trial);
  EXPECT_THAT(svg, HasSubstr(">rows &lt; 3 &amp; more</text>"));
  EXPECT_THAT(svg, AllOf(testing::StartsWith("<svg"), testing::EndsWith("</svg>\n")));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace vinebench::harness
