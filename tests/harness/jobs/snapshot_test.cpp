// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/snapshot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/core.hpp>

#include "harness/datasets/labels/label_table.h"
#include "sim/config_files.h"
#include "tests/support/mesh_world.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

TEST(ParseCameraTest, ThePrincipalPointIsInTheMiddle) {
  const PinholeCamera camera = parse_camera("752x480@263.3");
  EXPECT_EQ(camera.width, 752);
  EXPECT_EQ(camera.height, 480);
  EXPECT_EQ(camera.fx, 263.3);
  EXPECT_EQ(camera.fy, 263.3);
  EXPECT_EQ(camera.cx, 375.5);
  EXPECT_EQ(camera.cy, 239.5);
}

TEST(ParseCameraTest, AnythingElseIsAnError) {
  for (const char* text : {"", "752x480", "752x480@", "752x480@263px", "0x480@263", "752x480@0",
                           "752x480@-1", "752x480@inf", "752x480@nan"}) {
    EXPECT_THAT(error_of([&] { parse_camera(text); }), HasSubstr("WIDTHxHEIGHT@FOCAL")) << text;
  }
}

TEST(ParseViewTest, YawTurnsToTheLeftAndPitchUp) {
  const Pose ahead = parse_view("1,2,3,90");
  EXPECT_EQ(ahead.translation, Eigen::Vector3d(1, 2, 3));
  // 90 degrees to the left of east is north.
  EXPECT_LT((ahead.rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
  const Pose up = parse_view("0,0,0,0,30");
  EXPECT_NEAR((up.rotation * Eigen::Vector3d::UnitX()).z(), 0.5, 1e-12);  // sin 30 degrees
}

TEST(ParseViewTest, AnythingElseIsAnError) {
  for (const char* text :
       {"", "1,2,3", "1,2,3,4,5,6", "1,2,3,x", "1,,3,4", "1,2,3,4,", "1,2,3,nan"}) {
    EXPECT_THAT(error_of([&] { parse_view(text); }), HasSubstr("X,Y,Z,YAW")) << text;
  }
}

TEST(ColourLabelsTest, EachLabelHasTheTablesColour) {
  const cv::Mat labels = (cv::Mat_<std::uint8_t>(1, 2) << static_cast<int>(Label::kSky),
                          static_cast<int>(Label::kGround));
  const cv::Mat colours = colour_labels(labels);
  ASSERT_EQ(colours.type(), CV_8UC3);
  for (int x = 0; x < 2; ++x) {
    EXPECT_EQ(colours.at<cv::Vec3b>(0, x), label_colour(labels.at<std::uint8_t>(0, x)));
  }
  EXPECT_NE(colours.at<cv::Vec3b>(0, 0), colours.at<cv::Vec3b>(0, 1));
}

// The fake renderer's court has another pattern in each direction.
TEST(TurntableTest, HasEightViewsFromAllSides) {
  const test::TestFolder folder;
  const sim::WorldConfig world = sim::load_world(test::write_mesh_world(folder));
  sim::RendererConfig renderer;
  renderer.engine = sim::RenderEngineKind::kFake;
  const cv::Mat sheet = turntable(world, 1, parse_camera("40x30@20"), renderer, folder / "cache");
  ASSERT_EQ(sheet.size(), cv::Size(4 * 40, 2 * 30));
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < i; ++j) {
      const auto view = [&](int k) { return sheet(cv::Rect(k % 4 * 40, k / 4 * 30, 40, 30)); };
      EXPECT_GT(cv::norm(view(i), view(j), cv::NORM_INF), 0) << i << " and " << j;
    }
  }
}

}  // namespace
}  // namespace vinebench::harness
