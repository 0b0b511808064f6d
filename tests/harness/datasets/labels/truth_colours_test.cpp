// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/labels/truth_colours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/files/files.h"
#include "core/util/error.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// 2 px to the right, down, left, up; none; not known.
cv::Mat six_flows() {
  return (cv::Mat_<cv::Vec2f>(1, 6) << cv::Vec2f(2, 0), cv::Vec2f(0, 2), cv::Vec2f(-2, 0),
          cv::Vec2f(0, -2), cv::Vec2f(0, 0), cv::Vec2f(kNan, kNan));
}

TEST(TruthColoursTest, FlowIsAColourWheel) {
  const cv::Mat colours = colour_flow(six_flows());
  ASSERT_EQ(colours.type(), CV_8UC3);
  const auto at = [&](int x) { return colours.at<cv::Vec3b>(0, x); };
  EXPECT_EQ(at(0), cv::Vec3b(255, 0, 0));  // hue 0
  // Hues of 90, 180 and 270 degrees: yellow-green, cyan, blue-violet.
  EXPECT_LE(cv::norm(at(1), cv::Vec3b(128, 255, 0), cv::NORM_INF), 1);
  EXPECT_LE(cv::norm(at(2), cv::Vec3b(0, 255, 255), cv::NORM_INF), 1);
  EXPECT_LE(cv::norm(at(3), cv::Vec3b(128, 0, 255), cv::NORM_INF), 1);
  EXPECT_EQ(at(4), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(at(5), cv::Vec3b(0, 0, 0));
}

TEST(TruthColoursTest, OneLongFlowDoesNotPaleTheRest) {
  cv::Mat flow(20, 20, CV_32FC2, cv::Scalar(1, 0));
  flow.at<cv::Vec2f>(3, 3) = {1000, 0};
  EXPECT_EQ(colour_flow(flow).at<cv::Vec3b>(0, 0), cv::Vec3b(255, 0, 0));
}

TEST(TruthColoursTest, FloFilesAreMiddleburys) {
  const test::TestFolder folder;
  write_flow(folder / "flow.flo", six_flows());
  const std::string bytes = read_file(folder / "flow.flo");
  // "PIEH", width, height, then u and v of each pixel; 1e10 for what is not known.
  ASSERT_EQ(bytes.size(), 4 + 2 * 4 + 6 * 2 * 4u);
  EXPECT_EQ(bytes.substr(0, 4), "PIEH");
  std::array<std::int32_t, 2> size{};
  std::memcpy(size.data(), bytes.data() + 4, 8);
  EXPECT_EQ(size[0], 6);
  EXPECT_EQ(size[1], 1);
  std::array<float, 12> values{};
  std::memcpy(values.data(), bytes.data() + 12, 48);
  const std::array<float, 12> expected{2, 0, 0, 2, -2, 0, 0, -2, 0, 0, 1e10f, 1e10f};
  EXPECT_EQ(values, expected);
}

TEST(TruthColoursTest, FlowIsAlsoWrittenInColours) {
  const test::TestFolder folder;
  write_flow(folder / "flow.png", six_flows());
  // Blue first in a file as OpenCV reads it.
  EXPECT_EQ(cv::imread((folder / "flow.png").string()).at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 255));
  EXPECT_THROW(write_flow(folder / "flow.txt", six_flows()), Error);
}

TEST(TruthColoursTest, NormalsPointAlongTheColoursAxes) {
  const cv::Mat normals = (cv::Mat_<cv::Vec3f>(1, 4) << cv::Vec3f(1, 0, 0), cv::Vec3f(0, -1, 0),
                           cv::Vec3f(0, 0, -1), cv::Vec3f(0, 0, 0));
  const cv::Mat colours = colour_normals(normals);
  // 127.5 rounds to the even 128; y is down and z away in the camera's frame.
  EXPECT_EQ(colours.at<cv::Vec3b>(0, 0), cv::Vec3b(255, 128, 128));
  EXPECT_EQ(colours.at<cv::Vec3b>(0, 1), cv::Vec3b(128, 255, 128));
  EXPECT_EQ(colours.at<cv::Vec3b>(0, 2), cv::Vec3b(128, 128, 255));
  EXPECT_EQ(colours.at<cv::Vec3b>(0, 3), cv::Vec3b(0, 0, 0));
}

TEST(TruthColoursTest, EachInstanceHasOneColour) {
  const cv::Mat instances = (cv::Mat_<std::int32_t>(1, 4) << 0, 256, 257, 256);
  const cv::Mat colours = colour_instances(instances);
  const auto at = [&](int x) { return colours.at<cv::Vec3b>(0, x); };
  EXPECT_EQ(at(0), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(at(1), at(3));
  EXPECT_NE(at(1), at(2));
  for (int i = 0; i < 3; ++i) EXPECT_GE(at(1)[i], 50);  // distinguishable from none
}

TEST(TruthColoursTest, DisparityIsIn256thsOfAPixel) {
  const cv::Mat disparity = (cv::Mat_<float>(1, 3) << 0, 1.5f, 12.25f);
  const cv::Mat codes = kitti_disparity(disparity);
  ASSERT_EQ(codes.type(), CV_16UC1);
  EXPECT_EQ(codes.at<std::uint16_t>(0, 0), 0);
  EXPECT_EQ(codes.at<std::uint16_t>(0, 1), 384);
  EXPECT_EQ(codes.at<std::uint16_t>(0, 2), 3136);
}

}  // namespace
}  // namespace vinebench::harness
