// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/body_flow.h"

#include <gtest/gtest.h>

#include "core/truth/labels.h"

namespace vinebench {
namespace {

// A camera at the origin with the world's axes; the rover moves 0.5 m along x and turns a quarter
// to the left about its own origin at (0, 0, 2).
TEST(BodyFlowTest, OnlyTheRoversPixelsMoveWithIt) {
  const PinholeCamera camera{.width = 3, .height = 1, .fx = 1, .fy = 1, .cx = 1, .cy = 0};
  cv::Mat labels(1, 3, CV_8UC1, cv::Scalar(static_cast<int>(Label::kLeaf)));
  labels.at<std::uint8_t>(0, 2) = static_cast<std::uint8_t>(Label::kRover);
  const cv::Mat depth(1, 3, CV_32FC1, cv::Scalar(2));
  const Pose before{Eigen::Quaterniond::Identity(), {0, 0, 2}};
  const Pose after{Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ())),
                   {0.5, 0, 2}};
  cv::Mat motion;
  move_rover(camera, {}, before, after, labels, depth, motion);
  ASSERT_EQ(motion.type(), CV_32FC3);
  EXPECT_EQ(motion.at<cv::Vec3f>(0, 0), cv::Vec3f(0, 0, 0));
  // Pixel (2, 0) at depth 2 m with fx 1 px is (2, 0, 2): from the rover's origin (2, 0, 0), turned
  // (0, 2, 0), so that the point goes to (0.5, 2, 2).
  EXPECT_LT(cv::norm(motion.at<cv::Vec3f>(0, 2) - cv::Vec3f(-1.5f, 2, 0)), 1e-6);
}

// The body goes 1 m along x; only the pixel of the mask is its.
TEST(BodyFlowTest, OnlyThePixelsOfTheMaskMove) {
  const PinholeCamera camera{.width = 2, .height = 1, .fx = 1, .fy = 1, .cx = 0, .cy = 0};
  cv::Mat mask(1, 2, CV_8UC1, cv::Scalar(0));
  mask.at<std::uint8_t>(0, 1) = 255;
  const cv::Mat depth(1, 2, CV_32FC1, cv::Scalar(2));
  cv::Mat motion;
  move_body(camera, {}, {Eigen::Quaterniond::Identity(), {3, 0, 0}},
            {Eigen::Quaterniond::Identity(), {4, 0, 0}}, mask, depth, motion);
  EXPECT_EQ(motion.at<cv::Vec3f>(0, 0), cv::Vec3f(0, 0, 0));
  EXPECT_EQ(motion.at<cv::Vec3f>(0, 1), cv::Vec3f(1, 0, 0));
}

TEST(BodyFlowTest, OtherMotionIsKept) {
  const PinholeCamera camera{.width = 1, .height = 1, .fx = 1, .fy = 1, .cx = 0, .cy = 0};
  const cv::Mat labels(1, 1, CV_8UC1, cv::Scalar(static_cast<int>(Label::kLeaf)));
  const cv::Mat depth(1, 1, CV_32FC1, cv::Scalar(2));
  cv::Mat motion(1, 1, CV_32FC3, cv::Scalar(1, 2, 3));
  move_rover(camera, {}, {}, {Eigen::Quaterniond::Identity(), {9, 0, 0}}, labels, depth, motion);
  EXPECT_EQ(motion.at<cv::Vec3f>(0, 0), cv::Vec3f(1, 2, 3));
}

}  // namespace
}  // namespace vinebench
