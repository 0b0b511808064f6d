// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/realism/separability.h"

#include <gtest/gtest.h>

#include "core/util/random.h"

namespace vinebench::harness {
namespace {

/// Pictures with three statistics, normal about `mean`.
PictureSet pictures(int count, double mean, std::uint64_t seed, int groups) {
  RandomSequence draw{RandomStream(seed, "pictures")};
  PictureSet set;
  for (int i = 0; i < count; ++i) {
    MeasuredPicture picture;
    picture.group = std::to_string(i % groups);
    for (const char* name : {"a", "b", "c"})
      picture.statistics.emplace_back(name, draw.normal(mean));
    set.pictures.push_back(picture);
  }
  return set;
}

// Of four pairs three are in order and one is a tie.
TEST(SeparabilityTest, AreaIsTheShareOfPairsInOrder) {
  EXPECT_EQ(area_under_roc({3, 2}, {1, 2}), 3.5 / 4);
  EXPECT_EQ(area_under_roc({1}, {2}), 0);
}

// At the optimum the penalised likelihood's gradient is zero, and the constant's is that of the
// classes alone: sum of importance times (p - y) is 0.
TEST(SeparabilityTest, TheFitIsTheOptimum) {
  Eigen::MatrixXd rows(5, 1);
  rows << -2, -1, 0, 1, 2;
  Eigen::VectorXd positive(5);
  positive << 0, 0, 1, 0, 1;
  const Eigen::VectorXd weights = fit_logistic(rows, positive, 1);
  double slope = weights[0];
  double constant = 0;
  for (int i = 0; i < 5; ++i) {
    const double importance = 5 * (positive[i] > 0 ? 0.5 / 2 : 0.5 / 3);
    const double p = 1 / (1 + std::exp(-(weights[0] * rows(i, 0) + weights[1])));
    slope += importance * (p - positive[i]) * rows(i, 0);
    constant += importance * (p - positive[i]);
  }
  EXPECT_NEAR(slope, 0, 1e-8);
  EXPECT_NEAR(constant, 0, 1e-8);
  EXPECT_GT(weights[0], 0);
}

// Means 2 apart in each of three dimensions of deviation 1 are 3.5 apart along the diagonal: the
// area is that of a normal distribution below 3.5 / sqrt(2), 0.993.
TEST(SeparabilityTest, SeparatesWhatDiffers) {
  const auto found = separability(pictures(60, 0, 1, 60), pictures(40, 2, 2, 40));
  ASSERT_TRUE(found);
  EXPECT_GT(*found, 0.97);
}

// With 60 against 60 the area's standard deviation about 0.5 is 0.053.
TEST(SeparabilityTest, DoesNotSeparateWhatIsAlike) {
  const auto found = separability(pictures(60, 0, 1, 60), pictures(60, 0, 2, 60));
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 0.5, 0.16);
}

TEST(SeparabilityTest, NeedsFiveGroups) {
  EXPECT_FALSE(separability(pictures(60, 0, 1, 4), pictures(60, 2, 2, 60)));
}

}  // namespace
}  // namespace vinebench::harness
