// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/factors/tag_corner_factor.h"

#include <gtest/gtest.h>

#include "slam/tags/tag_sightings.h"
#include "tests/support/factor_check.h"

namespace vinebench::slam {
namespace {

using namespace test;

TEST(TagCornerFactorTest, JacobiansAreTheNumericOnes) {
  const StereoCameraModel e = camera();
  const Pose T_map_tag{exp_so3({0.3, -0.2, 0.5}), point()};
  expect_jacobian(TagCornerFactor(e, {300, 250}, 0.3, tag_corners(0.161)[1]),
                  {as_vector(to_block(body())), as_vector(to_block(T_map_tag))});
}

}  // namespace
}  // namespace vinebench::slam
