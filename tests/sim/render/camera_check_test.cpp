// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/camera_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_folder.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;

class CameraCheckTest : public testing::Test {
 protected:
  std::string problem() const {
    return test::error_of([&] { check_camera(camera_); });
  }
  PinholeCamera camera_ = test::small_camera();
};

TEST_F(CameraCheckTest, AnIdealPinholeUpToTheLargestImagePasses) {
  EXPECT_EQ(problem(), "");
  camera_.width = camera_.height = 8192;
  EXPECT_EQ(problem(), "");
  camera_.width = camera_.height = 1;
  EXPECT_EQ(problem(), "");
}

TEST_F(CameraCheckTest, EachSideIsChecked) {
  for (int PinholeCamera::*side : {&PinholeCamera::width, &PinholeCamera::height}) {
    for (const int wrong : {-3, 0, 8193}) {
      camera_ = test::small_camera();
      camera_.*side = wrong;
      EXPECT_THAT(problem(), HasSubstr("expected 1 to 8192 a side")) << wrong;
    }
  }
}

TEST_F(CameraCheckTest, FocalLengthsArePositiveNumbers) {
  for (double PinholeCamera::*focal : {&PinholeCamera::fx, &PinholeCamera::fy}) {
    for (const double wrong : {0.0, -263.0, std::nan("")}) {
      camera_ = test::small_camera();
      camera_.*focal = wrong;
      EXPECT_THAT(problem(), HasSubstr("focal lengths")) << wrong;
    }
  }
}

TEST_F(CameraCheckTest, DistortionIsRefused) {
  camera_.distortion[3] = 1e-4;
  EXPECT_THAT(problem(), HasSubstr("lens distortion"));
}

}  // namespace
}  // namespace vinebench::sim
