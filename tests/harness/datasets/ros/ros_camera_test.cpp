// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros/ros_camera.h"

#include <gmock/gmock.h>

#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

const PinholeCamera kLens{96, 64, 60, 62, 47.5, 31.5, {}};

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor34 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

RowMajor34 P_of(const RosCameraInfo& info) {
  return Eigen::Map<const RowMajor34>(info.P.data());
}

/// In the frame of the camera's rectified view.
Eigen::Vector3d rotated(const RosCameraInfo& info, const Eigen::Vector3d& p_cam) {
  return Eigen::Map<const RowMajor3>(info.R.data()) * p_cam;
}

TEST(RosCameraTest, ARectifiedPairHasItsBaselineInTheRightCamera) {
  const Rig rig = Rig::stereo(kLens, 0.12);
  const std::vector<RosCamera> cameras = ros_cameras(rig);
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].frame, "left_optical_frame");
  EXPECT_EQ(cameras[1].images, "/right/image_rect");
  EXPECT_EQ(cameras[1].info, "/right/camera_info");
  EXPECT_THAT(cameras[0].calibration.P,
              testing::ElementsAre(60, 0, 47.5, 0, 0, 62, 31.5, 0, 0, 0, 1, 0));
  EXPECT_THAT(cameras[1].calibration.P,
              testing::ElementsAre(60, 0, 47.5, testing::DoubleNear(-7.2, 1e-12), 0, 62, 31.5, 0, 0,
                                   0, 1, 0));
}

TEST(RosCameraTest, ALensWithDistortionIsRaw) {
  Rig rig = Rig::stereo(kLens, 0.12);
  rig.stereo_pairs.clear();
  rig.cameras[1].model.distortion = {-0.1, 0.02, 0.001, -0.002};
  const std::vector<RosCamera> cameras = ros_cameras(rig);
  EXPECT_EQ(cameras[0].images, "/left/image_rect");
  EXPECT_EQ(cameras[1].images, "/right/image_raw");
  EXPECT_THAT(cameras[1].calibration.D, testing::ElementsAre(-0.1, 0.02, 0.001, -0.002, 0));
  EXPECT_EQ(cameras[1].calibration.P[3], 0);  // of no pair
}

/// ROS: the right camera's P projects points of the left rectified view to the right image, where
/// the right camera, rotated by R, must see them.
TEST(RosCameraTest, RAndPRectifyAPairThatIsNot) {
  Rig rig = Rig::stereo(kLens, 0.12);
  Pose& T_body_right = rig.cameras[1].T_body_cam;
  T_body_right.rotation = T_body_right.rotation * exp_so3(Eigen::Vector3d(0.02, -0.03, 0.01));
  T_body_right.translation.x() += 0.004;
  const std::vector<RosCamera> cameras = ros_cameras(rig);
  EXPECT_EQ(cameras[0].images, "/left/image_raw");
  EXPECT_EQ(cameras[1].images, "/right/image_raw");
  const RosCameraInfo& left = cameras[0].calibration;
  const RosCameraInfo& right = cameras[1].calibration;
  EXPECT_EQ(left.P[3], 0);
  EXPECT_NEAR(right.P[3], -right.P[0] * rig.baseline(rig.stereo_pairs[0]), 1e-12);
  for (const Eigen::Vector3d& p_left :
       {Eigen::Vector3d(0.3, -0.2, 2), Eigen::Vector3d(-0.6, 0.4, 3), Eigen::Vector3d(0, 0, 8)}) {
    const Eigen::Vector3d p_right = T_body_right.inverse() * (rig.cameras[0].T_body_cam * p_left);
    const Eigen::Vector3d p_rectified = rotated(left, p_left);
    const Eigen::Vector2d in_left = (P_of(left) * p_rectified.homogeneous()).hnormalized();
    const Eigen::Vector2d in_right = (P_of(right) * p_rectified.homogeneous()).hnormalized();
    const Eigen::Vector2d seen =
        (P_of(right).leftCols<3>() * rotated(right, p_right)).hnormalized();
    EXPECT_LT((in_right - seen).norm(), 1e-9) << p_left.transpose();  // px
    EXPECT_NEAR(in_left.y(), seen.y(), 1e-9);
  }
}

TEST(RosCameraTest, ANameThatRosCannotHaveIsAnError) {
  for (const char* bad : {"front left", "2nd", "", "a/b", "vorne-links"}) {
    Rig rig = Rig::stereo(kLens, 0.12);
    rig.cameras[0].name = bad;
    EXPECT_THAT(error_of([&] { ros_cameras(rig); }), HasSubstr("expected a name of letters"))
        << bad;
  }
}

}  // namespace
}  // namespace vinebench::harness
