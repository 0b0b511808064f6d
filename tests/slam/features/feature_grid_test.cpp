// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/feature_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/util/random.h"

namespace vinebench::slam {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Keypoint keypoint(float x, float y, int level = 0) {
  Keypoint k;
  k.x = x;
  k.y = y;
  k.level = level;
  return k;
}

std::vector<int> query(const FeatureGrid& grid, float x, float y, float radius, int low = 0,
                       int high = 7) {
  std::vector<int> result;
  grid.query(x, y, radius, low, high, result);
  return result;
}

TEST(FeatureGrid, FindsWhatAFullSearchFinds) {
  RandomSequence draws(RandomStream(1, "grid"));
  std::vector<Keypoint> keypoints;
  for (int i = 0; i < 800; ++i) {
    keypoints.push_back(keypoint(static_cast<float>(draws.uniform(-0.5, 751.5)),
                                 static_cast<float>(draws.uniform(-0.5, 479.5)), draws.below(8)));
  }
  const FeatureGrid grid(keypoints, 752, 480);
  for (int i = 0; i < 200; ++i) {
    // Centres up to 60 px off the image, windows from nothing to most of it.
    const auto x = static_cast<float>(draws.uniform(-60, 812));
    const auto y = static_cast<float>(draws.uniform(-60, 540));
    const auto radius = static_cast<float>(draws.uniform(0, 200));
    const int low = draws.below(8);
    const int high = low + draws.below(3);
    std::vector<int> expected;
    for (std::size_t k = 0; k < keypoints.size(); ++k) {
      const Keypoint& p = keypoints[k];
      if (std::abs(p.x - x) <= radius && std::abs(p.y - y) <= radius && p.level >= low &&
          p.level <= high) {
        expected.push_back(static_cast<int>(k));
      }
    }
    std::vector<int> found = query(grid, x, y, radius, low, high);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(FeatureGrid, OrdersByCellThenIndex) {
  // Cells are 16 px: indices 1 and 3 share the first, 2 lies in the next, 0 in the row below.
  const FeatureGrid grid({keypoint(5, 20), keypoint(9, 9), keypoint(20, 5), keypoint(2, 2)}, 64,
                         64);
  EXPECT_THAT(query(grid, 16, 16, 30), ElementsAre(1, 3, 2, 0));
}

TEST(FeatureGrid, AppendsToTheResult) {
  const FeatureGrid grid({keypoint(5, 5)}, 64, 64);
  std::vector<int> result{42};
  grid.query(5, 5, 1, 0, 0, result);
  EXPECT_THAT(result, ElementsAre(42, 0));
}

TEST(FeatureGrid, KeepsKeypointsOffTheImage) {
  const FeatureGrid grid({keypoint(-30, 500)}, 64, 64);
  EXPECT_THAT(query(grid, -30, 500, 1), ElementsAre(0));
  EXPECT_THAT(query(grid, 0, 63, 20), IsEmpty());
}

TEST(FeatureGrid, EmptyOrUndefinedQueriesFindNothing) {
  EXPECT_THAT(query(FeatureGrid(), 1, 1, 100), IsEmpty());
  EXPECT_THAT(query(FeatureGrid({}, 752, 480), 1, 1, 100), IsEmpty());
  const FeatureGrid grid({keypoint(5, 5)}, 64, 64);
  EXPECT_THAT(query(grid, 5, 5, -1), IsEmpty());
  EXPECT_THAT(query(grid, std::numeric_limits<float>::quiet_NaN(), 5, 10), IsEmpty());
}

}  // namespace
}  // namespace vinebench::slam
