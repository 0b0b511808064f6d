// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/render_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "harness/datasets/labels/label_table.h"
#include "tests/support/mesh_world.h"

namespace vinebench::harness {
namespace {

using testing::HasSubstr;

class RenderViewTest : public testing::Test {
 protected:
  RenderViewTest() {
    request_.world = test::write_mesh_world(folder_);
    request_.camera = "40x30@20";
    request_.pose = "0,0,0.5,90";
    request_.out = file("view.png");
    request_.machine.plant_cache = folder_ / "cache";
  }
  std::string file(const char* name) const { return (folder_ / name).string(); }
  std::string write_rig() const {
    return folder_
        .write("rig.yaml",
               "name: two\n"
               "cameras:\n"
               "  - {name: large, width: 64, height: 48, fx: 20, fy: 20}\n"
               "  - {name: small, width: 40, height: 30, fx: 20, fy: 20}\n")
        .string();
  }
  std::string error() const {
    return test::error_of([&] { render_view(request_); });
  }
  static cv::Mat read(const std::string& file) { return cv::imread(file, cv::IMREAD_UNCHANGED); }

  test::TestFolder folder_;
  ViewRequest request_;
};

// From 0.5 m above the ground, looking north at 20 px: row 29 is 14.5 px below the axis, its ground
// at 0.5 m * 20 / 14.5 = 0.690 m of depth. One test, because building the world takes most of it.
TEST_F(RenderViewTest, WritesTheImagesThatAreNamed) {
  request_.rig = write_rig();
  request_.camera = "small";
  request_.labels = file("labels.png");
  request_.depth = file("depth.png");
  request_.disparity = file("disparity.png");
  request_.baseline = 0.1;
  request_.flow_visible = file("visible.png");
  request_.flow_to = "0.1,0,0.5,90";
  render_view(request_);
  EXPECT_EQ(read(request_.out).size(), cv::Size(40, 30));
  const cv::Vec3b ground = label_colour(static_cast<std::uint8_t>(Label::kGround));
  EXPECT_EQ(read(request_.labels).at<cv::Vec3b>(29, 20),
            cv::Vec3b(ground[2], ground[1], ground[0]));                // files are BGR
  EXPECT_NEAR(read(request_.depth).at<std::uint16_t>(29, 20), 690, 1);  // mm
  // KITTI's unit is 1/256 px: 20 px * 0.1 m / 0.690 m = 2.9 px.
  EXPECT_NEAR(read(request_.disparity).at<std::uint16_t>(29, 20) / 256.0, 2.9, 0.01);
  // 0.1 m to the east the ground is 2.9 px further left, where column 1 is outside of the image.
  EXPECT_EQ(read(request_.flow_visible).at<std::uint8_t>(29, 20), 255);
  EXPECT_EQ(read(request_.flow_visible).at<std::uint8_t>(29, 1), 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "normals.png"));
}

TEST_F(RenderViewTest, IncompleteRequestsAreErrors) {
  request_.pose.clear();
  EXPECT_THAT(error(), HasSubstr("expected --pose"));
  request_.pose = "0,0";
  EXPECT_THAT(error(), HasSubstr("X,Y,Z,YAW"));
  request_.pose = "0,0,0.5,90";
  request_.flow = file("flow.png");
  EXPECT_THAT(error(), HasSubstr("--flow-to X,Y,Z,YAW together"));
  request_.flow.clear();
  request_.flow_to = "0,0,0.5,90";
  EXPECT_THAT(error(), HasSubstr("--flow-to X,Y,Z,YAW together"));
  request_.flow_to.clear();
  request_.rover_to = "0,0,0,0";
  EXPECT_THAT(error(), HasSubstr("--rover X,Y,Z,YAW with --rover-to"));
}

TEST_F(RenderViewTest, ACameraThatTheRigLacksIsNamed) {
  request_.rig = write_rig();
  request_.camera = "back";
  EXPECT_THAT(error(), HasSubstr("rig.yaml: no camera is named 'back'"));
}

TEST_F(RenderViewTest, ATurntableIsNotExported) {
  request_.turntable = true;
  request_.export_to = file("view");
  EXPECT_THAT(error(), HasSubstr("--pose with --export"));
}

}  // namespace
}  // namespace vinebench::harness
