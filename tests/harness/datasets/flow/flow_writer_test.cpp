// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/flow/flow_writer.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

TEST(FlowWriterTest, KittiCodesAreSixtyFourthsAroundTheMiddle) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const cv::Mat flow =
      (cv::Mat_<cv::Vec2f>(1, 3) << cv::Vec2f(1.5f, -2), cv::Vec2f(kNone, 0), cv::Vec2f(600, 0));
  const cv::Mat codes = kitti_flow(flow);
  // 32768 + 64 * 1.5 and 32768 - 64 * 2; 600 px would be 71168, more than 16 bits.
  EXPECT_EQ(codes.at<cv::Vec3w>(0, 0), cv::Vec3w(32864, 32640, 1));
  EXPECT_EQ(codes.at<cv::Vec3w>(0, 1), cv::Vec3w(0, 0, 0));
  EXPECT_EQ(codes.at<cv::Vec3w>(0, 2), cv::Vec3w(0, 0, 0));
}

TEST(FlowWriterTest, ACameraWithDistortionIsAnError) {
  const test::TestFolder folder;
  RecordingNotes notes;
  RigCamera camera;
  camera.name = "left";
  camera.model.distortion[0] = 0.1;
  notes.true_cameras.push_back(camera);
  EXPECT_EQ(test::error_of([&] {
              FlowWriter({folder.path(), {}}, notes);
            }),
            "flow: camera 'left' has lens distortion, expected ideal pinholes");
}

}  // namespace
}  // namespace vinebench::harness
