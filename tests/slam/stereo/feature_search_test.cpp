// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/stereo/feature_search.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

constexpr int kRows = 100;            // px
constexpr double kMaxDisparity = 50;  // px

/// A descriptor with so many of its first bits set.
Descriptor bits(int count) {
  Descriptor descriptor{};
  for (int i = 0; i < count; ++i) descriptor[static_cast<std::size_t>(i / 64)] |= 1ULL << (i % 64);
  return descriptor;
}

class FeatureSearchTest : public testing::Test {
 protected:
  void add(float x, float y, int level, const Descriptor& descriptor) {
    right_.keypoints.push_back({.x = x, .y = y, .level = level});
    right_.descriptors.push_back(descriptor);
  }
  /// Of a feature at (60, 50) on the level, whose descriptor is zero.
  std::optional<double> disparity(int level = 0) const {
    return FeatureSearch(right_, kRows, extractor_)
        .disparity_of({.x = 60, .y = 50, .level = level}, Descriptor{}, kMaxDisparity);
  }
  OrbExtractor extractor_{OrbConfig{}};
  Features right_;
};

TEST_F(FeatureSearchTest, TakesTheMostAlikeOnTheRow) {
  add(40, 50, 0, bits(30));
  add(45, 51, 1, bits(10));
  EXPECT_EQ(disparity(), 15);  // 60 - 45
}

TEST_F(FeatureSearchTest, TheRowIsWideByTwoPixelsOfTheLevel) {
  add(40, 53, 0, bits(0));
  EXPECT_FALSE(disparity(0));  // 3 px off, 2 are allowed
  right_.keypoints[0].level = 3;
  EXPECT_EQ(disparity(3), 20);  // 2 * 1.2^3 = 3.46 px
}

TEST_F(FeatureSearchTest, OtherLevelsSidesAndDistancesAreLeftOut) {
  add(40, 50, 2, bits(0));  // two levels away
  add(61, 50, 0, bits(0));  // behind the cameras
  add(9, 50, 0, bits(0));   // 51 px, beyond the limit
  EXPECT_FALSE(disparity());
}

TEST_F(FeatureSearchTest, WhatIsUnlikeOrAmbiguousIsNoMatch) {
  add(40, 50, 0, bits(65));  // 64 bits are allowed
  EXPECT_FALSE(disparity());
  add(30, 50, 0, bits(52));
  EXPECT_EQ(disparity(), 30);  // 52 < 0.85 * 65 = 55.25
  add(20, 50, 0, bits(60));
  EXPECT_FALSE(disparity());  // 52 >= 0.85 * 60 = 51
}

}  // namespace
}  // namespace vinebench::slam
