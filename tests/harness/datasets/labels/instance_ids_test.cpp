// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/instance_ids.h"

#include <gtest/gtest.h>

namespace vinebench::harness {
namespace {

TEST(InstanceIdsTest, AnIdIsRedAndGreenAndBlue) {
  const cv::Mat ids = (cv::Mat_<std::int32_t>(1, 2) << 0, 3 * 65536 + 2 * 256 + 1);
  const cv::Mat colours = id_colours(ids);
  EXPECT_EQ(colours.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(colours.at<cv::Vec3b>(0, 1), cv::Vec3b(1, 2, 3));
}

TEST(InstanceIdsTest, NothingIsNumberZero) {
  EXPECT_EQ(instance_id(SceneIndex{}, 0), 0);
  EXPECT_EQ(cv::countNonZero(instance_ids(SceneIndex{}, cv::Mat::zeros(2, 3, CV_32SC1))), 0);
}

}  // namespace
}  // namespace vinebench::harness
