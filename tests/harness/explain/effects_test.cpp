// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/explain/effects.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vinebench::harness {
namespace {

/// 0.1 m a frame ahead; the estimate is that of a map that lies elsewhere.
std::vector<Step> drive() {
  const Pose T_map_world{from_roll_pitch_yaw({0, 0, 1}), {3, 2, 1}};
  std::vector<Step> steps;
  for (std::int64_t i = 4; i <= 10; ++i) {
    Step step{.index = i, .stamp = stamp_of_frame(i, 10), .T_world_body = {}, .tracked = true};
    step.T_world_body.translation.x() = 0.1 * static_cast<double>(i);
    step.T_map_body = T_map_world * step.T_world_body;
    steps.push_back(step);
  }
  return steps;
}

const Stretch kStretch{.first = 6, .last = 9};

TEST(EffectsTest, APerfectEstimateDoesNotDrift) {
  const StretchDrift drift = drift_of(drive(), kStretch, 4);
  EXPECT_NEAR(drift.metres, 0, 1e-12);
  EXPECT_NEAR(drift.end, 0, 1e-12);
  EXPECT_EQ(drift.lost, 0);
}

// Off by 3 cm in frames 8 and 9, of which one is dead reckoning, and by 1 m after the stretch: the
// root of the mean of {0, 0, 9, 9} cm^2 is 2.12 cm. Frame 7 has no pose: {0, 9, 9} give 2.45 cm.
TEST(EffectsTest, DriftIsThatOfTheStretchsPoses) {
  std::vector<Step> steps = drive();
  for (const std::size_t i : {4, 5}) steps[i].T_map_body->translation.z() += 0.03;
  steps[5].tracked = false;
  steps[6].T_map_body->translation.z() += 1;
  StretchDrift drift = drift_of(steps, kStretch, 4);
  EXPECT_NEAR(drift.metres, 0.0212, 1e-4);
  EXPECT_NEAR(drift.end, 0.03, 1e-9);
  EXPECT_EQ(drift.lost, 1);
  steps[3].T_map_body.reset();
  steps[3].tracked = false;
  drift = drift_of(steps, kStretch, 4);
  EXPECT_NEAR(drift.metres, 0.0245, 1e-4);
  EXPECT_EQ(drift.lost, 2);
}

// Whatever was wrong before the frame that is aligned does not count.
TEST(EffectsTest, DriftBeginsWhereItIsAligned) {
  std::vector<Step> steps = drive();
  steps[0].T_map_body->translation.x() += 5;
  EXPECT_NEAR(drift_of(steps, kStretch, 5).metres, 0, 1e-12);
  EXPECT_NEAR(drift_of(steps, kStretch, 4).metres, 5, 1e-9);
}

TEST(EffectsTest, NothingIsKnownWithoutAPose) {
  std::vector<Step> steps = drive();
  for (Step& step : steps) {
    step.T_map_body.reset();
    step.tracked = false;
  }
  EXPECT_EQ(drift_of(steps, kStretch, 4).metres, 0);
  EXPECT_EQ(drift_of(steps, kStretch, 4).lost, 4);
}

StretchDrift drifted(double metres, double lost = 0) {
  return {.metres = metres, .end = metres, .lost = lost};
}

// Values of which the logarithms are 4, 5, 6, 4 and 6: their mean is 5, their deviation 1.
// Student's t on one side, 99 % and 4 degrees of freedom, is 3.75; the difference of the mean of r
// more runs and that of the five has a deviation of sqrt(1 / r + 1 / 5).
TEST(EffectsTest, TheLimitOfChanceIsStudentsOnLogarithms) {
  const auto e = [](double x) { return std::exp(x) - 0.5; };
  const Chance chance({e(4), e(5), e(6), e(4), e(6)}, 0.5);
  EXPECT_EQ(chance.runs(), 5);
  EXPECT_NEAR(chance.typical(), e(5), 1e-9);
  const double one = 3.75 * std::sqrt(1.2);
  EXPECT_NEAR(chance.limit(), std::exp(5) - std::exp(5 - one), 1e-9);
  EXPECT_TRUE(chance.is_undercut_by({e(5 - one - 0.01)}));
  EXPECT_FALSE(chance.is_undercut_by({e(5 - one + 0.01)}));
  EXPECT_TRUE(chance.is_exceeded_by({e(5 + one + 0.01)}));
  EXPECT_FALSE(chance.is_exceeded_by({e(5 + one - 0.01)}));
  const double three = 3.75 * std::sqrt(1.0 / 3 + 0.2);
  EXPECT_TRUE(chance.is_undercut_by({e(4.8 - three), e(4.9 - three), e(5.2 - three)}));
  EXPECT_FALSE(chance.is_undercut_by({e(4.9 - three), e(5.0 - three), e(5.2 - three)}));
}

// Equal placebos count as spread by a tenth: t of 99 % with 2 degrees of freedom is 6.96.
TEST(EffectsTest, EqualPlacebosProveLittle) {
  const Chance chance({0.02, 0.02, 0.02}, 0);
  EXPECT_EQ(chance.deviation(), 0);
  const double limit = 0.02 * std::exp(-6.96 * 0.1 * std::sqrt(4.0 / 3));
  EXPECT_TRUE(chance.is_undercut_by({0.99 * limit}));
  EXPECT_FALSE(chance.is_undercut_by({1.01 * limit}));
  EXPECT_FALSE(Chance({0.02}, 0).is_undercut_by({1e-9}));  // one run has no spread
}

/// 20 mm, give or take half a millimetre.
AsItWas twenty_millimetres() {
  return as_it_was(
      {drifted(0.020), drifted(0.0205), drifted(0.0195), drifted(0.0205), drifted(0.0195)});
}

// Five runs with a deviation of a tenth: a single rerun must have less than exp(-0.41) = 0.66 times
// the 21 mm (with the floor of 1 mm), 13 mm.
TEST(EffectsTest, ACauseIsBeyondChanceAndNotLittle) {
  const AsItWas was = twenty_millimetres();
  EXPECT_NEAR(was.metres.typical(), 0.020, 1e-12);
  EXPECT_TRUE(effect_of(was, {drifted(0.012)}).is_cause());
  EXPECT_NEAR(effect_of(was, {drifted(0.012)}).metres, 0.008, 1e-12);
  EXPECT_FALSE(effect_of(was, {drifted(0.014)}).is_cause());
  EXPECT_TRUE(effect_of(was, {drifted(0.014)}).is_open);
  // A fifth is 0.22 on the logarithm's scale; the standard error is a tenth of sqrt(1.2), 0.11.
  // 17 mm are 0.15 less with the floor, which may be a fifth; 19 mm are 0.05 less.
  EXPECT_FALSE(effect_of(was, {drifted(0.017)}).is_cause());
  EXPECT_TRUE(effect_of(was, {drifted(0.017)}).is_open);
  EXPECT_FALSE(effect_of(was, {drifted(0.019)}).is_open);
  EXPECT_FALSE(effect_of(was, {drifted(0.030)}).is_open);  // worse without it
  const AsItWas wild = as_it_was({drifted(0.010), drifted(0.040), drifted(0.020)});
  EXPECT_FALSE(effect_of(wild, {drifted(0.002)}).is_cause());
  const AsItWas tiny = as_it_was({drifted(0.0008), drifted(0.0008), drifted(0.0008)});
  EXPECT_FALSE(effect_of(tiny, {drifted(0)}).is_open);  // 0.8 mm
}

// Three reruns need exp(-3.75 * 0.1 * sqrt(1 / 3 + 1 / 5)) = 0.76 times, 15 mm.
TEST(EffectsTest, MoreRerunsDecide) {
  const AsItWas was = twenty_millimetres();
  EXPECT_TRUE(effect_of(was, {drifted(0.014), drifted(0.014), drifted(0.0145)}).is_cause());
}

TEST(EffectsTest, LostFramesHaveACauseToo) {
  const AsItWas was = as_it_was({drifted(0.01, 10), drifted(0.01, 10), drifted(0.01, 10)});
  EXPECT_TRUE(effect_of(was, {drifted(0.01, 0)}).losses_are_caused);
  EXPECT_FALSE(effect_of(was, {drifted(0.01, 0)}).drift_is_caused);
  EXPECT_FALSE(effect_of(was, {drifted(0.01, 9)}).is_open);  // one frame
}

// Each alone takes nothing away, both take away 15 of 20 mm.
TEST(EffectsTest, SinglesNeedNotAddUp) {
  const AsItWas was = twenty_millimetres();
  const Effect nothing = effect_of(was, {drifted(0.020)});
  const Effect both = effect_of(was, {drifted(0.005)});
  EXPECT_TRUE(do_not_add_up(was, {nothing, nothing}, both));
  EXPECT_NEAR(interaction_of(nothing, nothing, both).metres, 0.015, 1e-12);
  const Effect half = effect_of(was, {drifted(0.0125)});
  EXPECT_FALSE(do_not_add_up(was, {half, half}, both));
  const Effect worse = effect_of(was, {drifted(0.030)});
  EXPECT_FALSE(do_not_add_up(was, {both, worse}, both));  // what is worse without it takes nothing
  EXPECT_NEAR(interaction_of(both, both, both).metres, -0.015, 1e-12);
}

// Most frames are lost, and by the wheels the drive drifts by 1.3 mm all the same: 0.9 mm of it, or
// one frame of three, is too little to ask which pair it is.
TEST(EffectsTest, WhatIsNothingNeedNotAddUp) {
  const AsItWas was = as_it_was({drifted(0.0013, 3), drifted(0.0013, 3), drifted(0.0013, 3)});
  Effect both{.metres = 0.9e-3, .lost = 1, .drift_is_caused = true, .losses_are_caused = true};
  EXPECT_FALSE(do_not_add_up(was, {Effect{}, Effect{}}, both));
  both.metres = 1.1e-3;
  EXPECT_TRUE(do_not_add_up(was, {Effect{}, Effect{}}, both));
  both.metres = 0;
  both.lost = 2;
  EXPECT_TRUE(do_not_add_up(was, {Effect{}, Effect{}}, both));
}

// Without any factor 5 mm, with all 20 mm: a cause that would do alone adds 4 mm, a fifth of those.
// With a deviation of a tenth and five runs, one rerun is beyond chance from exp(0.41) times the
// 6 mm (with the floor) on, at 8.05 mm; one of at most that may add 4 mm (log of 10 to 6 is 0.51)
// where it says 0.51 - 0.11, of 8 mm and more.
TEST(EffectsTest, OneThatWouldDoAloneAddsWhatACauseTakesAway) {
  const AsItWas was = twenty_millimetres();
  const AsItWas nothing = as_it_was(
      {drifted(0.005), drifted(0.0051), drifted(0.0049), drifted(0.0051), drifted(0.0049)});
  const Effect all{.metres = 0.015, .drift_is_caused = true};
  const auto with = [&](double metres) {
    return effect_alone(nothing, {drifted(metres)}, was, all);
  };
  EXPECT_TRUE(with(0.0095).is_cause());
  EXPECT_NEAR(with(0.0095).metres, 0.0045, 1e-12);
  EXPECT_FALSE(with(0.0085).is_cause());  // beyond chance, but little
  EXPECT_TRUE(with(0.0085).is_open);
  EXPECT_FALSE(with(0.0070).is_open);
  EXPECT_FALSE(effect_alone(nothing, {drifted(0.0095)}, was, {}).is_cause());  // not of the drift
}

// Of ten lost frames, a fifth are two. With the floor of two frames, one rerun is beyond chance
// from 2 exp(6.96 * 0.1 * sqrt(4 / 3)) = 4.5 on, with 3 lost frames.
TEST(EffectsTest, OneThatWouldDoAloneMayLoseFrames) {
  const AsItWas was = as_it_was({drifted(0, 10), drifted(0, 10), drifted(0, 10)});
  const AsItWas nothing = as_it_was({drifted(0), drifted(0), drifted(0)});
  const Effect all{.lost = 10, .losses_are_caused = true};
  EXPECT_TRUE(effect_alone(nothing, {drifted(0, 3)}, was, all).is_cause());
  EXPECT_FALSE(effect_alone(nothing, {drifted(0, 2)}, was, all).is_cause());
  EXPECT_TRUE(effect_alone(nothing, {drifted(0, 2)}, was, all).is_open);
  EXPECT_FALSE(effect_alone(nothing, {drifted(0, 1)}, was, all).is_open);
}

// Without the first cause 30 mm of 500 are left, without any factor 6: 24 mm, four fifths, are for
// others.
TEST(EffectsTest, WhatACauseLeavesMayHaveOthers) {
  const std::vector<StretchDrift> some{drifted(0.030), drifted(0.033), drifted(0.020)};
  EXPECT_TRUE(leaves_more(some, {drifted(0.006)}));
  EXPECT_FALSE(leaves_more(some, {drifted(0.0245)}));  // 5.5 mm of 30: less than a fifth
  EXPECT_TRUE(leaves_more(some, {drifted(0.0235)}));
  EXPECT_FALSE(leaves_more({drifted(0.0015)}, {drifted(0.0006)}));     // less than a millimetre
  EXPECT_TRUE(leaves_more({drifted(0.001, 3)}, {drifted(0.001, 1)}));  // two of three frames
  EXPECT_FALSE(leaves_more({drifted(0.001, 3)}, {drifted(0.001, 2)}));
}

}  // namespace
}  // namespace vinebench::harness
