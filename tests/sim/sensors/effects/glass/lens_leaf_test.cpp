// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/effects/glass/lens_leaf.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/effect_camera.h"

namespace vinebench::sim {
namespace {

class LensLeafTest : public testing::Test {
 protected:
  LensLeafTest() {
    config_.size = 0.5;  // 45 px
    config_.blur_px = 0;
  }
  cv::Mat behind() const {
    return test::applied(*make_lens_leaves({config_}, camera_.inputs()), camera_, 1);
  }
  cv::Rect covered() const { return cv::boundingRect(cv::Mat(test::channel(behind(), 0) < 1)); }
  test::EffectCamera camera_;
  LensLeafConfig config_;
};

/// Its tip is 1 / 1.6 of its length, 28 px, away from its middle at (59.5, 45); its teeth are 5 %
/// of that, 1.4 px.
TEST_F(LensLeafTest, ItsTipPointsWhereItsAngleSays) {
  EXPECT_NEAR(covered().y, 45 - 28, 2.5);
  config_.angle_deg = 90;
  EXPECT_NEAR(covered().br().x, 60 + 28, 2.5);
  config_.angle_deg = 180;
  EXPECT_NEAR(covered().br().y, 45 + 28, 2.5);
  config_.angle_deg = -90;
  EXPECT_NEAR(covered().x, 60 - 28, 2.5);
}

TEST_F(LensLeafTest, IsAsLongAsItsShareOfTheHeight) {
  // The lobes beside the stalk reach back a little farther than its notch: a tenth.
  EXPECT_NEAR(covered().height, 45, 4.5);
  config_.size = 0.25;
  EXPECT_NEAR(covered().height, 22.5, 3);
}

TEST_F(LensLeafTest, ItsMiddleIsAtItsShareOfTheImage) {
  const cv::Rect centred = covered();
  config_.position = {0.25, 0.75};  // 30 px to the left, 22.5 px down
  const cv::Rect moved = covered();
  EXPECT_NEAR(moved.x, centred.x - 30, 1);
  EXPECT_NEAR(moved.y, centred.y + 22.5, 1);
}

TEST_F(LensLeafTest, TakesTheLightByItsOpacityAndIsGreenAgainstIt) {
  const cv::Vec3f opaque = behind().at<cv::Vec3f>(45, 60);
  EXPECT_GT(opaque[1], opaque[0]);
  EXPECT_GT(opaque[1], opaque[2]);
  EXPECT_LT(opaque[1], 0.3);
  config_.opacity = 0.5;  // half of its own, half of the image's light of 1
  const cv::Vec3f half = behind().at<cv::Vec3f>(45, 60);
  EXPECT_LT(cv::norm(half - 0.5 * (opaque + cv::Vec3f::all(1))), 1e-6);
}

TEST_F(LensLeafTest, IsOnTheCamerasOfItsScopeAlone) {
  config_.scope.cameras = {"right"};
  EXPECT_EQ(make_lens_leaves({config_}, camera_.inputs()), nullptr);
}

}  // namespace
}  // namespace vinebench::sim
