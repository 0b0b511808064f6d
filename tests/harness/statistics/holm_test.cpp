// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/statistics/holm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/util/random.h"

namespace vinebench::harness {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

// In order 0.005, 0.01, 0.03, 0.04: times 4, 3, 2, 1 gives 0.02, 0.03, 0.06, 0.04; the last may not
// be below the one before it.
TEST(HolmTest, StepsDown) {
  EXPECT_THAT(holm_adjusted({0.01, 0.04, 0.03, 0.005}),
              ElementsAre(DoubleNear(0.03, 1e-15), DoubleNear(0.06, 1e-15), DoubleNear(0.06, 1e-15),
                          DoubleNear(0.02, 1e-15)));
}

TEST(HolmTest, StaysAProbability) {
  EXPECT_THAT(holm_adjusted({0.7, 0.6}), ElementsAre(1, 1));
  EXPECT_THAT(holm_adjusted({0.7}), ElementsAre(0.7));
  EXPECT_THAT(holm_adjusted({}), IsEmpty());
}

// Of ten metrics seven have no difference (uniform p-values) and three have a large one. Any false
// claim among the seven: at most 5 %, and 1 - 0.95^7 = 30 % without the correction. Four standard
// deviations over 10,000 trials are 0.9 %.
TEST(HolmTest, AnyFalseClaimIsRare) {
  RandomSequence random(RandomStream(4, "holm"));
  constexpr int kTrials = 10'000;
  int adjusted = 0;
  int plain = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> p{1e-9, 1e-9, 1e-9};
    while (p.size() < 10) p.push_back(random.uniform());
    const std::vector<double> corrected = holm_adjusted(p);
    const auto any = [](const std::vector<double>& values) {
      return std::any_of(values.begin() + 3, values.end(), [](double v) { return v <= 0.05; });
    };
    adjusted += any(corrected);
    plain += any(p);
  }
  EXPECT_LE(adjusted, kTrials * 0.059);
  EXPECT_GT(adjusted, kTrials * 0.040);  // 1 - (1 - 0.05 / 7)^7 = 4.9 %: not wasteful either
  EXPECT_GT(plain, kTrials * 0.25);
}

}  // namespace
}  // namespace vinebench::harness
