// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/validate.h"
#include "core/util/error.h"
#include "sim/world/vines.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

TEST(GrowthStageTest, AnUnknownStageIsRefusedWithTheKnownOnes) {
  EXPECT_THAT(test::error_of([] { growth_stage(50); }),
              testing::AllOf(testing::HasSubstr("0 (dormant)"),
                             testing::HasSubstr("95 (leaf fall)"), testing::HasSubstr("found 50")));
  VinesConfig vines;
  vines.bbch = 50;
  EXPECT_THROW(validate(vines), Error);
}

TEST(GrowthStageTest, EveryStageHasItsCode) {
  for (const int code : {0, 9, 65, 75, 79, 83, 89, 95}) {
    EXPECT_EQ(growth_stage(code).bbch, code);
    EXPECT_EQ(bbch_problem(code), "");
  }
  EXPECT_STREQ(growth_stage(83).name, "veraison");
}

TEST(GrowthStageTest, TheGroundIsGreenestInSummer) {
  EXPECT_GT(withered_share(0), withered_share(9));
  EXPECT_GT(withered_share(9), withered_share(75));
  EXPECT_GT(withered_share(95), withered_share(89));
}

TEST(GrowthStageTest, WinterIsDull) {
  EXPECT_GT(usual_overcast(0), 0.5);
  for (const int code : {9, 65, 75, 83, 89, 95}) EXPECT_EQ(usual_overcast(code), 0);
}

// Before the berries swell, a bunch has a fifth of its width.
TEST(GrowthStageTest, BunchesWidenWithTheirBerries) {
  GrowthStage stage;
  stage.berry = 0;
  EXPECT_FLOAT_EQ(stage.bunch_width(), 0.2f);
  EXPECT_FLOAT_EQ(growth_stage(89).bunch_width(), 1);
}

}  // namespace
}  // namespace vinebench::sim
