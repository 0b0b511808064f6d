// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/judge/image_conditions.h"

#include <gtest/gtest.h>

#include "tests/support/steady_drive.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kTick = 100;
constexpr std::size_t kLeft = 0;
constexpr std::size_t kRight = 1;

/// 0.5 m/s and 300 px: 150 px/s at 1 m.
class ImageConditionsTest : public test::SteadyDrive {
 protected:
  ImageConditionsTest() { tick().truth.captures.resize(3); }
  Tick& tick() { return record_.ticks[kTick]; }
  ImageConditions conditions() const { return {record_, trial_.site}; }
};

TEST_F(ImageConditionsTest, NothingIsSaidOfWhatIsUnknown) {
  tick().truth = {};
  tick().truth.T_world_body.translation.x() = 5;
  EXPECT_FALSE(conditions().is_blurred(kTick, kLeft));
  EXPECT_FALSE(conditions().is_rolling(kTick, kLeft));
  EXPECT_FALSE(conditions().is_mistimed(kTick, kLeft));
  EXPECT_FALSE(conditions().is_badly_exposed(kTick, kLeft));
  EXPECT_EQ(conditions().occlusion(kTick, kLeft).total(), 0);
}

// In 14 ms 2.1 px, in 13 ms 1.95 px.
TEST_F(ImageConditionsTest, ARollingShutterIsCountedInPixels) {
  tick().truth.captures[kLeft].readout_time = 0.014;
  EXPECT_TRUE(conditions().is_rolling(kTick, kLeft));
  EXPECT_FALSE(conditions().is_rolling(kTick, kRight));
  tick().truth.captures[kLeft].readout_time = 0.013;
  EXPECT_FALSE(conditions().is_rolling(kTick, kLeft));
}

// Half a pixel are 3.3 ms. The stamp is 3 ms after the left and 3 ms before the right exposure: 6
// ms lie between the two.
TEST_F(ImageConditionsTest, TimesCountWithinAPairAndToTheStamp) {
  tick().truth.captures[kLeft].stamp_error = 0.003;
  tick().truth.captures[kRight].stamp_error = 0.003;
  EXPECT_FALSE(conditions().is_mistimed(kTick, kLeft));
  tick().truth.captures[kRight].stamp_error = -0.003;
  EXPECT_TRUE(conditions().is_mistimed(kTick, kLeft));
  tick().truth.captures[kLeft].stamp_error = tick().truth.captures[kRight].stamp_error = -0.004;
  EXPECT_TRUE(conditions().is_mistimed(kTick, kLeft));
}

TEST_F(ImageConditionsTest, DarkSaturatedAndNoisyImagesAreBadlyExposed) {
  const auto bad = [&](const Brightness& brightness, double gain_db) {
    tick().brightness.assign(3, brightness);
    tick().truth.captures[kLeft].gain_db = gain_db;
    return conditions().is_badly_exposed(kTick, kLeft);
  };
  EXPECT_FALSE(bad({.dark = 0.9, .saturated = 0.4}, 11));
  EXPECT_TRUE(bad({.dark = 0.96, .saturated = 0}, 0));
  EXPECT_TRUE(bad({.dark = 0, .saturated = 0.5}, 0));
  EXPECT_TRUE(bad({}, 12));
  tick().delivered[kLeft] = false;
  EXPECT_FALSE(bad({}, 12));
}

TEST_F(ImageConditionsTest, MovingIsWhatHasAPath) {
  trial_.site.objects = {{.kind = OccluderClass::kPerson, .moves = true},
                         {.kind = OccluderClass::kCarton}};
  tick().truth.occlusion[kLeft].share(OccluderClass::kPerson) = 0.25;
  tick().truth.occlusion[kLeft].share(OccluderClass::kCarton) = 0.5;
  EXPECT_EQ(conditions().moving(kTick, kLeft).total(), 0.25);
  EXPECT_EQ(conditions().occlusion(kTick, kLeft).total(), 0.75);
}

}  // namespace
}  // namespace vinebench::harness
