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
  // the right of the principal point in the right camera.
  const double disparity = e.lens.fx * e.baseline / 2;
  const Eigen::Vector2d pixel(e.lens.cx + 100 + disparity, 100);
  EXPECT_NEAR(e.disparity_of(pixel, 2), disparity + 0.4 - 1, 1e-12);
  // The inverse takes the right column as it is measured, which is off by a pixel: a hundredth of
  // a pixel through the slope, and the second round of that leaves its square.
  EXPECT_NEAR(e.depth_of(pixel, e.disparity_of(pixel, 2)), 2, 1e-4);
}

// A right camera that is turned by up to 2 mrad about each axis, 1 mm ahead of 120, of a focal
// length 0.2 % longer and a principal point 0.3 px to the right. At the image's edge a ray is
// off by up to 6e-3 in all, whose square is 0.01 px of 263.
TEST(StereoCameraModelTest, DisparitiesAreThoseOfARightCameraThatIsOff) {
  StereoCameraModel e = camera();
  e.right_turn = {0.002, -0.0015, 0.001};
  e.right_ahead = 0.001 / e.baseline;
  e.disparity_slope = 0.002;
  e.disparity_offset = 0.3 - e.lens.fx * e.right_turn.y();  // as it is in the middle
  const Pose T_left_right{exp_so3(e.right_turn), {e.baseline, 0, 0.001}};
  PinholeCamera right = e.lens;
  right.fx *= 1.002;
  right.cx += 0.3;
  for (const double depth : {0.6, 2.0, 10.0}) {
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(30, 20), {375, 240}, {700, 400}}) {
      const Eigen::Vector3d p = e.lens.unproject(pixel) * depth;
      const double seen = right.project(T_left_right.inverse() * p).x();
      EXPECT_NEAR(pixel.x() - e.disparity_of(pixel, depth), seen, 0.015);
      EXPECT_NEAR(e.depth_of(pixel, e.disparity_of(pixel, depth)), depth, 1e-4 * depth);
    }
  }
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
  pair.principal_point = {0.5, -0.25};
  const StereoCameraModel found = calibrated(camera(), pair);
  EXPECT_NEAR(found.lens.fx, 265.911386, 1e-9);
  EXPECT_NEAR(found.lens.fy, 265.911386, 1e-9);
  EXPECT_NEAR(found.baseline, 0.1176, 1e-12);
  EXPECT_EQ(found.lens.cx, camera().lens.cx + 0.5);
  EXPECT_EQ(found.lens.cy, camera().lens.cy - 0.25);
  EXPECT_NEAR((found.T_cam_body * point()).z(), (camera().T_cam_body * point()).z() - 0.01, 1e-12);
  // The first row of 480 is half a readout before the middle.
  EXPECT_NEAR(found.time_of(0), 0.005 - 0.015, 1e-12);
  EXPECT_NEAR(found.time_of(240), 0.005, 1e-12);
  EXPECT_TRUE(found.has_times());
  EXPECT_FALSE(camera().has_times());
}

}  // namespace
}  // namespace vinebench::slam
