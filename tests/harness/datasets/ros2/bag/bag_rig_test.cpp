// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/bag_rig.h"

#include <gmock/gmock.h>

#include "harness/datasets/ros/ros_camera.h"
#include "harness/datasets/ros2/cdr/ros2_messages.h"
#include "tests/support/small_bag.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

/// A bag of these cameras, not mounted.
BagContents contents_of(const std::vector<test::BagCameraSpec>& cameras) {
  BagContents contents;
  contents.names = {"run.mcap"};
  for (const test::BagCameraSpec& spec : cameras) {
    contents.images[spec.topic] = {ros2::kImage, spec.frame, "mono8", {}};
    contents.cameras[spec.info] = test::small_info(spec, 1);
  }
  return contents;
}

Rig rig_of(const BagContents& contents) {
  return read_bag_rig(contents, choose_bag_cameras(contents, {})).rig;
}

void mount(BagContents& contents, const std::string& child, const RosPose& pose) {
  contents.mounts.push_back(test::mount_of(child, pose));
}

TEST(BagRigTest, WithoutMountsTheBodyIsAtTheLeftCamera) {
  const Rig rig = rig_of(contents_of(test::small_pair()));
  ASSERT_EQ(rig.cameras.size(), 2u);
  EXPECT_EQ(rig.cameras[0].model.width, 32);
  EXPECT_EQ(rig.cameras[0].model.fx, 20);
  EXPECT_EQ(rig.cameras[0].model.cy, 7.5);
  EXPECT_EQ(rig.cameras[0].T_body_cam.translation.norm(), 0);
  // The camera's z axis is the body's x axis, and x to the right is -y.
  EXPECT_LT(
      (rig.cameras[0].T_body_cam * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(1, 0, 0)).norm(),
      1e-12);
  EXPECT_LT((rig.cameras[1].T_body_cam.translation - Eigen::Vector3d(0, -0.1, 0)).norm(), 1e-12);
}

TEST(BagRigTest, MountsOnBaseLinkAreTheCamerasPlaces) {
  BagContents contents = contents_of(test::small_pair());
  mount(contents, "left_optical_frame", test::optical_at(1, 0.05, 2));
  mount(contents, "right_optical_frame", test::optical_at(1, -0.05, 2));
  const Rig rig = rig_of(contents);
  EXPECT_EQ(rig.cameras[0].T_body_cam.translation, Eigen::Vector3d(1, 0.05, 2));
  EXPECT_LT((rig.cameras[1].T_body_cam.translation - Eigen::Vector3d(1, -0.05, 2)).norm(), 1e-12);
}

/// What RosWriter's cameras say of a rig that is not rectified is that rig.
TEST(BagRigTest, ARawPairComesBackFromItsMountsAndFromRAndP) {
  Rig rig = Rig::stereo({96, 64, 60, 62, 47.5, 31.5, {-0.1, 0.02, 0.001, -0.002}}, 0.12);
  Pose& T_body_right = rig.cameras[1].T_body_cam;
  T_body_right.rotation = T_body_right.rotation * exp_so3(Eigen::Vector3d(0.02, -0.03, 0.01));
  BagContents contents;
  contents.names = {"run.mcap"};
  for (const RosCamera& camera : ros_cameras(rig)) {
    contents.images[camera.images] = {ros2::kImage, camera.frame, "mono8", {}};
    contents.cameras[camera.info] = camera.calibration;
  }
  const auto expect_same = [&](const Rig& back, double tolerance) {
    ASSERT_EQ(back.cameras.size(), 2u);
    EXPECT_EQ(back.cameras[0].model.distortion, rig.cameras[0].model.distortion);
    EXPECT_EQ(back.cameras[0].model.fy, 62);
    const auto relative = [](const Rig& r) {
      return r.cameras[0].T_body_cam.inverse() * r.cameras[1].T_body_cam;
    };
    const Pose difference = relative(back).inverse() * relative(rig);
    EXPECT_LT(difference.translation.norm(), tolerance);
    EXPECT_LT(angle_of(difference.rotation), tolerance);
  };
  expect_same(rig_of(contents), 1e-9);  // m and rad: rounding of R's entries
  for (const RigCamera& camera : rig.cameras) {
    const Pose& T = camera.T_body_cam;
    const Eigen::Quaterniond& q = T.rotation;
    mount(
        contents, camera.name + "_optical_frame",
        {{T.translation.x(), T.translation.y(), T.translation.z()}, {q.x(), q.y(), q.z(), q.w()}});
  }
  expect_same(rig_of(contents), 1e-12);
}

TEST(BagRigTest, OtherCamerasAreForTagsWhereTheirPlaceIsKnown) {
  auto cameras = test::small_pair();
  cameras.push_back({"/side/image_raw", "/side/camera_info", "side_optical_frame", 0, 0});
  BagContents contents = contents_of(cameras);
  EXPECT_EQ(rig_of(contents).cameras.size(), 2u);
  mount(contents, "left_optical_frame", test::optical_at(0, 0, 0));
  mount(contents, "right_optical_frame", test::optical_at(0, -0.1, 0));
  mount(contents, "side_optical_frame", test::optical_at(0, 0, 1));
  const Rig rig = rig_of(contents);
  ASSERT_EQ(rig.cameras.size(), 3u);
  EXPECT_THAT(rig.tag_cameras, ElementsAre(2));
  EXPECT_EQ(rig.cameras[2].T_body_cam.translation.z(), 1);
}

TEST(BagRigTest, CalibrationsThatCannotBeUsedAreErrors) {
  const auto error_with = [](const auto& change) {
    BagContents contents = contents_of(test::small_pair());
    change(contents.cameras.at("/right/camera_info"));
    return error_of([&] { rig_of(contents); });
  };
  EXPECT_THAT(error_with([](RosCameraInfo& info) { info.width = 15; }),
              HasSubstr("topic /right/camera_info: expected 16 to 16384 pixels a side, found 15"));
  EXPECT_THAT(error_with([](RosCameraInfo& info) { info.P[0] = 0; }),
              HasSubstr("focal lengths above 0"));
  EXPECT_THAT(error_with([](RosCameraInfo& info) { info.P[5] = std::nan(""); }),
              HasSubstr("focal lengths above 0"));
  EXPECT_THAT(error_with([](RosCameraInfo& info) { info.P[3] = 0; }),
              HasSubstr("P[3] = -fx times the baseline"));
  EXPECT_THAT(error_of([] {
                auto cameras = test::small_pair();
                cameras[1].info = "/elsewhere/camera_info";
                rig_of(contents_of(cameras));
              }),
              HasSubstr("expected the calibration of /right/image_rect on /right/camera_info"));
}

TEST(BagRigTest, LensesThatAreNotSupportedAreErrors) {
  const auto error_with = [](const std::string& model, const std::vector<double>& D) {
    auto cameras = test::small_pair();
    for (auto& camera : cameras)
      camera.topic = camera.topic.substr(0, camera.topic.size() - 4) + "raw";
    BagContents contents = contents_of(cameras);
    contents.cameras.at("/left/camera_info").model = model;
    contents.cameras.at("/left/camera_info").D = D;
    return error_of([&] { rig_of(contents); });
  };
  EXPECT_EQ(error_with("plumb_bob", {-0.1, 0.01, 0, 0, 0}), "");
  EXPECT_EQ(error_with("rational_polynomial", {-0.1, 0.01, 0, 0, 0, 0, 0, 0}), "");
  EXPECT_EQ(error_with("", {}), "");
  EXPECT_EQ(error_with("plumb_bob", {-0.1, 0.01, 0, 0, 0.1}), "");  // k3
  EXPECT_EQ(error_with("equidistant", {-0.1, 0.01, 0.002, -0.001}), "");
  EXPECT_THAT(error_with("rational_polynomial", {-0.1, 0.01, 0, 0, 0.1, 0.2, 0, 0}),
              HasSubstr("or these and k3, found more"));
  EXPECT_THAT(error_with("equidistant", {-0.1, 0.01, 0, 0, 0.1}), HasSubstr("found more"));
  EXPECT_THAT(error_with("omni", {-0.1, 0.01, 0, 0}), HasSubstr("found omni"));
}

TEST(BagRigTest, WithoutAPairItIsAnError) {
  auto cameras = test::small_pair();
  cameras.pop_back();
  EXPECT_THAT(error_of([&] { rig_of(contents_of(cameras)); }), HasSubstr("expected a stereo pair"));
}

TEST(BagRigTest, FramesArePlacedOnTheBody) {
  BagContents contents = contents_of(test::small_pair());
  contents.mounts.push_back(test::mount_of("imu", {{0, 0, 1}, {0, 0, 0, 1}}, "left_optical_frame"));
  const BagRig place = place_frames(contents, choose_bag_cameras(contents, {}));
  // A metre along the camera's axis is a metre ahead.
  EXPECT_LT((place.body_from("imu")->translation - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_FALSE(place.body_from("elsewhere"));
}

}  // namespace
}  // namespace vinebench::harness
