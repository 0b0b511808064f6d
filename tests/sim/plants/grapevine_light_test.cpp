// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_light.h"

#include <gtest/gtest.h>

namespace vinebench::sim {
namespace {

/// Horizontal leaves of 0.1 m in a block of 0.4 m around the origin.
std::vector<BladePlacement> foliage(int layers) {
  std::vector<BladePlacement> leaves;
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = 0; z < layers; ++z) {
        BladePlacement leaf;
        leaf.shading_normal = Eigen::Vector3f::UnitZ();
        leaf.foot = 0.1f * Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y),
                                           static_cast<float>(z));
        leaf.axes = axes_along(Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitX());
        leaf.size = 0.1f;
        leaves.push_back(leaf);
      }
    }
  }
  return leaves;
}

TEST(CanopyLightTest, WithoutLeavesAllLightArrives) {
  EXPECT_EQ(CanopyLight({}).at({0, 0, 1}), 1);
}

TEST(CanopyLightTest, AboveTheCanopyItIsTheSkysAlmostWhole) {
  EXPECT_GT(CanopyLight(foliage(4)).at({0, 0, 2}), 0.99f);  // rays reach 0.4 m
}

TEST(CanopyLightTest, MoreLeavesLetLessLightThrough) {
  const Eigen::Vector3f below(0, 0, -0.05f);
  const float one = CanopyLight(foliage(1)).at(below);
  const float four = CanopyLight(foliage(4)).at(below);
  EXPECT_LT(one, 0.99f);
  EXPECT_LT(four, one);
  EXPECT_GE(four, 0.12f);  // what is left in the densest canopy
}

}  // namespace
}  // namespace vinebench::sim
