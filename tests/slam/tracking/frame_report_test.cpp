// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tracking/frame_report.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

/// A rig of one pair, cameras 2 and 0 of three, and a frame with three features in it. Two have a
/// depth, the first and the last are tracked.
class FrameReportTest : public testing::Test {
 protected:
  FrameReportTest() {
    rig_.cameras.resize(3);
    rig_.pairs.resize(1);
    rig_.pairs[0].left_camera = 2;
    rig_.pairs[0].right_camera = 0;
    tracked_.frame = std::make_shared<FrameFeatures>();
    tracked_.frame->stamp = 70;
    tracked_.frame->tags.resize(2);
    tracked_.frame->views.resize(1);
    FrameFeatures& frame = *tracked_.frame;
    frame.views[0].features.keypoints.resize(3);
    frame.views[0].features.keypoints[0].x = 10;
    frame.views[0].features.keypoints[2].x = 30;
    frame.views[0].features.keypoints[2].y = 5;
    frame.views[0].features.descriptors.resize(3);
    frame.views[0].stereo = {StereoMatch{8, 1.5F}, StereoMatch{}, StereoMatch{20, 2.0F}};
    tracked_.tracked = true;
    tracked_.motion.matches_per_view = {3};
    tracked_.motion.inliers_per_view = {2};
    tracked_.associations = {{5, -1, 7}};
  }

  StereoRig rig_;
  TrackedFrame tracked_;
};

TEST_F(FrameReportTest, CountsByCamera) {
  const Estimate estimate = report_of(tracked_, rig_, TrackingStatus::kTracking);
  EXPECT_EQ(estimate.stamp, 70);
  EXPECT_EQ(estimate.status, TrackingStatus::kTracking);
  EXPECT_EQ(estimate.tags.size(), 2u);
  EXPECT_FALSE(estimate.T_map_body);
  ASSERT_EQ(estimate.cameras.size(), 3u);
  EXPECT_EQ(estimate.cameras[2].features, 3);
  EXPECT_EQ(estimate.cameras[2].stereo, 2);
  EXPECT_EQ(estimate.cameras[2].matches, 3);
  EXPECT_EQ(estimate.cameras[2].inliers, 2);
  EXPECT_EQ(estimate.cameras[0].features, 2);  // found in the right image
  EXPECT_EQ(estimate.cameras[1].features, 0);  // of no pair
}

TEST_F(FrameReportTest, TrackedFeaturesSupportThePose) {
  SupportingFeatures supporting;
  EXPECT_TRUE(supporting.in_images(rig_).empty());
  supporting.keep(tracked_);
  const std::vector<SupportingFeature> features = supporting.in_images(rig_);
  ASSERT_EQ(features.size(), 2u);
  EXPECT_EQ(features[0].camera, 2);
  EXPECT_EQ(features[0].pixel, Eigen::Vector2d(10, 0));
  EXPECT_EQ(features[1].pixel, Eigen::Vector2d(30, 5));
  tracked_.tracked = false;
  supporting.keep(tracked_);
  EXPECT_TRUE(supporting.in_images(rig_).empty());
}

}  // namespace
}  // namespace vinebench::slam
