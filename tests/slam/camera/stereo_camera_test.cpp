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
  e.disparity_slope = 0.01;
  // At 2 m by lens and baseline; 0.4 px more for the offset, and 1 px less for the slope 100 px to
  // the right of the principal point.
  const double x = e.lens.cx + 100;
  EXPECT_NEAR(e.disparity_of(x, 2), e.lens.fx * e.baseline / 2 + 0.4 - 1, 1e-12);
  EXPECT_NEAR(e.depth_of(x, e.disparity_of(x, 2)), 2, 1e-12);
}

// Shares of the nominal camera's 263.2786 px and 0.12 m; a camera that sits 1 cm further along its
// own axis sees everything 1 cm nearer.
TEST(StereoCameraModelTest, ACalibrationIsOfTheNominalCamera) {
  PairCalibration pair;
  pair.T_nominal_camera.translation = {0, 0, 0.01};
  pair.focal = 0.01;
  pair.baseline = -0.02;
  pair.time = 0.005;
  pair.readout = 0.03;
  const StereoCameraModel found = calibrated(camera(), pair);
  EXPECT_NEAR(found.lens.fx, 265.911386, 1e-9);
  EXPECT_NEAR(found.lens.fy, 265.911386, 1e-9);
  EXPECT_NEAR(found.baseline, 0.1176, 1e-12);
  EXPECT_NEAR((found.T_cam_body * point()).z(), (camera().T_cam_body * point()).z() - 0.01, 1e-12);
  // The first row of 480 is half a readout before the middle.
  EXPECT_NEAR(found.time_of(0), 0.005 - 0.015, 1e-12);
  EXPECT_NEAR(found.time_of(240), 0.005, 1e-12);
  EXPECT_TRUE(found.has_times());
  EXPECT_FALSE(camera().has_times());
}

}  // namespace
}  // namespace vinebench::slam
