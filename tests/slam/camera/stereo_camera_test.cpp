// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/camera/stereo_camera.h"

#include <gtest/gtest.h>

#include "tests/support/factor_check.h"

namespace vinebench::slam {
namespace {

using namespace test;

TEST(StereoCameraModelTest, DepthAndDisparityAreEachOthersInverse) {
  StereoCameraModel e = camera();
  e.disparity_offset = -0.4;
  // At 2 m by lens and baseline, and 0.4 px more for the offset.
  EXPECT_NEAR(e.disparity_of(2), e.lens.fx * e.baseline / 2 + 0.4, 1e-12);
  EXPECT_NEAR(e.depth_of(e.disparity_of(2)), 2, 1e-12);
}

}  // namespace
}  // namespace vinebench::slam
