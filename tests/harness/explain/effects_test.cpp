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

// Student's t of 99 % with 4 degrees of freedom is 4.60; the difference of one more run and the
// mean of five has a deviation of sqrt(1 + 1 / 5) times that of a run.
TEST(EffectsTest, TheLimitOfChanceIsStudents) {
  const Chance chance = chance_of({4, 5, 6, 4, 6});
  EXPECT_DOUBLE_EQ(chance.mean, 5);
  EXPECT_DOUBLE_EQ(chance.deviation, 1);
  EXPECT_NEAR(chance.limit(), 4.60 * std::sqrt(1.2), 1e-9);
  EXPECT_NEAR(chance.limit(3), 4.60 * std::sqrt(3.2), 1e-9);
  EXPECT_NEAR(chance.limit(3, 2), 4.60 * std::sqrt(3.8), 1e-9);
  EXPECT_TRUE(std::isinf(chance_of({4}).limit()) || std::isnan(chance_of({4}).limit()));
}

StretchDrift drifted(double metres, double lost = 0) {
  return {.metres = metres, .end = metres, .lost = lost};
}

/// 20 mm with a deviation of 0.5 mm: the limit of chance is 2.5 mm, a fifth is 4 mm.
AsItWas twenty_millimetres() {
  return as_it_was({drifted(0.020), drifted(0.0205), drifted(0.0195), drifted(0.0205),
                    drifted(0.0195)});
}

TEST(EffectsTest, ACauseIsBeyondChanceAndNotLittle) {
  const AsItWas was = twenty_millimetres();
  EXPECT_NEAR(was.metres.mean, 0.020, 1e-12);
  EXPECT_TRUE(effect_of(was, drifted(0.015)).is_cause());
  EXPECT_NEAR(effect_of(was, drifted(0.015)).metres, 0.005, 1e-12);
  EXPECT_FALSE(effect_of(was, drifted(0.017)).is_cause());  // 3 mm are less than a fifth
  EXPECT_FALSE(effect_of(was, drifted(0.030)).is_cause());  // worse without it
  const AsItWas wild = as_it_was({drifted(0.010), drifted(0.030), drifted(0.020)});
  EXPECT_FALSE(effect_of(wild, drifted(0)).is_cause());
  const AsItWas tiny = as_it_was({drifted(0.0008), drifted(0.0008), drifted(0.0008)});
  EXPECT_FALSE(effect_of(tiny, drifted(0)).is_cause());  // 0.8 mm
}

TEST(EffectsTest, LostFramesHaveACauseToo) {
  const AsItWas was = as_it_was({drifted(0.01, 10), drifted(0.01, 10), drifted(0.01, 10)});
  EXPECT_TRUE(effect_of(was, drifted(0.01, 0)).losses_are_caused);
  EXPECT_FALSE(effect_of(was, drifted(0.01, 0)).drift_is_caused);
  EXPECT_FALSE(effect_of(was, drifted(0.01, 9)).is_cause());  // one frame
}

// Each alone takes nothing away, both take away 15 of 20 mm: either would do.
TEST(EffectsTest, PairsInteractWhereSinglesDoNotAddUp) {
  const AsItWas was = twenty_millimetres();
  const Effect nothing = effect_of(was, drifted(0.020));
  const Effect both = effect_of(was, drifted(0.005));
  EXPECT_TRUE(do_not_add_up(was, {nothing, nothing}, both));
  const Interaction interaction = interaction_of(was, nothing, nothing, both);
  EXPECT_TRUE(interaction.certain);
  EXPECT_NEAR(interaction.metres, 0.015, 1e-12);
  const Effect half = effect_of(was, drifted(0.0125));
  EXPECT_FALSE(do_not_add_up(was, {half, half}, both));
  EXPECT_FALSE(interaction_of(was, half, half, both).certain);
  EXPECT_NEAR(interaction_of(was, both, both, both).metres, -0.015, 1e-12);
}

}  // namespace
}  // namespace vinebench::harness
