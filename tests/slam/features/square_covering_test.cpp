// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/features/square_covering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "core/util/random.h"

namespace vinebench::slam {
namespace {

constexpr int kImageWidth = 640;
constexpr int kImageHeight = 400;

/// 4000 corners, three quarters of them in a corner of the image, and the strongest ones there.
std::vector<Corner> crowded_corners() {
  RandomSequence draws(RandomStream(3, "crowd"));
  std::vector<Corner> corners;
  for (int i = 0; i < 4000; ++i) {
    const bool crowded = i % 4 != 0;
    corners.push_back({draws.below(crowded ? 160 : kImageWidth),
                       draws.below(crowded ? 100 : kImageHeight),
                       crowded ? 40 + draws.below(100) : 7 + draws.below(30)});
  }
  return corners;
}

bool same(const std::vector<Corner>& a, const std::vector<Corner>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Corner& p, const Corner& q) {
    return p.x == q.x && p.y == q.y && p.score == q.score;
  });
}

TEST(SquareCovering, KeepsNearlyTheWantedCountAndNeverMore) {
  for (const int count : {10, 50, 200, 500}) {
    const auto kept = suppress_square_covering(crowded_corners(), count, kImageWidth, kImageHeight);
    EXPECT_LE(static_cast<int>(kept.size()), count);
    EXPECT_GE(static_cast<int>(kept.size()), count * 9 / 10);
  }
}

TEST(SquareCovering, SpreadsEvenly) {
  // A sixteenth of the area is the crowded corner. By strength alone all 200 would come from it;
  // spread evenly 13 of 200 would, and every quarter of the image would have some.
  const auto kept = suppress_square_covering(crowded_corners(), 200, kImageWidth, kImageHeight);
  const auto inside = [&](int x, int y, int width, int height) {
    return std::count_if(kept.begin(), kept.end(), [&](const Corner& c) {
      return c.x >= x && c.x < x + width && c.y >= y && c.y < y + height;
    });
  };
  EXPECT_LT(inside(0, 0, 160, 100), 30);
  for (const int x : {0, 320}) {
    for (const int y : {0, 200}) EXPECT_GT(inside(x, y, 320, 200), 35);
  }
}

TEST(SquareCovering, KeepsADistance) {
  // About 200 squares tile 640 x 400: a side of 36 px each if they did not overlap.
  const auto kept = suppress_square_covering(crowded_corners(), 200, kImageWidth, kImageHeight);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(std::max(std::abs(kept[i].x - kept[j].x), std::abs(kept[i].y - kept[j].y)), 12);
    }
  }
}

TEST(SquareCovering, TheStrongestIsFirstAndAlwaysKept) {
  std::vector<Corner> corners = crowded_corners();
  corners.push_back({300, 200, 255});
  const auto kept = suppress_square_covering(corners, 20, kImageWidth, kImageHeight);
  ASSERT_FALSE(kept.empty());
  EXPECT_EQ(kept.front().score, 255);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end(),
                             [](const Corner& a, const Corner& b) { return a.score > b.score; }));
}

TEST(SquareCovering, OrderOfTheInputDoesNotMatter) {
  std::vector<Corner> corners = crowded_corners();
  const auto kept = suppress_square_covering(corners, 100, kImageWidth, kImageHeight);
  std::reverse(corners.begin(), corners.end());
  EXPECT_TRUE(same(kept, suppress_square_covering(corners, 100, kImageWidth, kImageHeight)));
}

TEST(SquareCovering, FewCornersAreAllKept) {
  const std::vector<Corner> two{{5, 5, 9}, {6, 5, 10}};
  EXPECT_EQ(suppress_square_covering(two, 2, kImageWidth, kImageHeight).size(), 2U);
  EXPECT_EQ(suppress_square_covering(two, 1, kImageWidth, kImageHeight).size(), 1U);
  EXPECT_TRUE(suppress_square_covering(two, 0, kImageWidth, kImageHeight).empty());
  EXPECT_TRUE(suppress_square_covering({}, 5, kImageWidth, kImageHeight).empty());
}

}  // namespace
}  // namespace vinebench::slam
