// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/kalibr_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/recorded_folders.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;

class KalibrChainTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) {
    return folder_.write("camchain.yaml", text);
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  }
  test::TestFolder folder_;
};

TEST_F(KalibrChainTest, TheBodyIsTheInertialUnit) {
  const auto file = write(test::kalibr_camera("cam0", 0) + test::kalibr_camera("cam1", -0.1));
  EXPECT_TRUE(is_kalibr_chain(file));
  const auto [rig, delays] = load_kalibr_chain(file);
  EXPECT_TRUE(delays.empty());
  ASSERT_EQ(rig.cameras.size(), 2u);
  EXPECT_EQ(rig.cameras[1].name, "cam1");
  EXPECT_EQ(rig.cameras[1].model.width, test::kWidth);
  EXPECT_EQ(rig.cameras[1].model.coefficients(), (std::vector<double>{0.01, -0.001, 0.002, 0}));
  // Camera 1 is 0.1 m to the right, that is along -y, and looks along x.
  EXPECT_LT((rig.cameras[1].T_body_cam.translation - Eigen::Vector3d(0, -0.1, 0)).norm(), 1e-12);
  EXPECT_LT(
      (rig.cameras[1].T_body_cam.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX())
          .norm(),
      1e-12);
}

TEST_F(KalibrChainTest, WithoutAUnitTheOthersFollowTheFirst) {
  // x_1 = x_0 + (-0.1, 0, 0): camera 1 is 0.1 m to the right of camera 0; likewise 2 of 1.
  const std::string lens =
      "  camera_model: pinhole\n  distortion_coeffs: [-0.3, 0.1, 0, 0]\n"
      "  distortion_model: radtan\n  intrinsics: [20, 20, 15, 11]\n  resolution: [32, 24]\n";
  const std::string next =
      "  T_cn_cnm1: [[1, 0, 0, -0.1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n";
  const Rig rig =
      load_kalibr_chain(write("cam0:\n" + lens + "cam1:\n" + lens + next + "cam2:\n" + lens + next))
          .rig;
  ASSERT_EQ(rig.cameras.size(), 3u);
  EXPECT_LT(rig.cameras[0].T_body_cam.translation.norm(), 1e-12);
  EXPECT_LT((rig.cameras[2].T_body_cam.translation - Eigen::Vector3d(0, -0.2, 0)).norm(), 1e-12);
  EXPECT_THAT(rig.tag_cameras, testing::ElementsAre(2));
  EXPECT_EQ(rig.stereo_pairs.size(), 1u);
}

// The unit's clock is what Kalibr's shift makes of the camera's.
TEST_F(KalibrChainTest, ShiftsAreDelaysOfImages) {
  const std::string first = test::kalibr_camera("cam0", 0);
  const std::string second = test::kalibr_camera("cam1", -0.1);
  const std::string shift = "  timeshift_cam_imu: ";
  EXPECT_THAT(load_kalibr_chain(write(first + second + shift + "-0.0021\n")).image_delays,
              testing::ElementsAre(0, -2'100'000));
  EXPECT_TRUE(load_kalibr_chain(write(first + shift + "0.0\n" + second)).image_delays.empty());
}

TEST_F(KalibrChainTest, WhatCannotBeUsedIsAnErrorWithItsLine) {
  const std::string first = test::kalibr_camera("cam0", 0);
  const std::string second = test::kalibr_camera("cam1", -0.1);
  const auto error = [&](const std::string& text) {
    const auto file = write(text);
    return error_of([&] { load_kalibr_chain(file); });
  };
  EXPECT_THAT(error(first), HasSubstr("expected a cam1 beside cam0"));
  EXPECT_THAT(error(first + replaced(second, "T_cam_imu", "T_imu_cam")),
              HasSubstr("cam1: expected T_cam_imu or T_cn_cnm1"));
  EXPECT_THAT(error(first + replaced(second, "[0, -1, 0,", "[0, -2, 0,")),
              HasSubstr("camchain.yaml:16: T_cam_imu: expected a rotation"));
  EXPECT_THAT(error(first + replaced(second, "[1, 0, 0, 0]", "1")),
              HasSubstr("T_cam_imu: expected four rows of numbers"));
  EXPECT_THAT(error(first + replaced(second, "T_cam_imu:", "T_cam_imu: {x: 1}\n  rows:")),
              HasSubstr("T_cam_imu: expected four rows of numbers"));
  EXPECT_THAT(error(first + replaced(second, "[1, 0, 0, 0]", "[1, 0]")),
              HasSubstr("T_cam_imu: expected four rows of four numbers"));
  EXPECT_THAT(error(first + replaced(second, "model: pinhole", "model: omni")),
              HasSubstr("camera_model: expected pinhole or ds, found 'omni'"));
  EXPECT_THAT(error(first + replaced(second, "0.002, 0]", "0.002]")),
              HasSubstr("distortion_coeffs: expected k1, k2, k3, k4"));
  for (const char* shift : {"10.5", ".nan", "late", "[0]"}) {
    EXPECT_THAT(error(first + "  timeshift_cam_imu: " + shift + "\n" + second),
                HasSubstr("camchain.yaml:14: timeshift_cam_imu: expected seconds, less than 10"));
  }
  EXPECT_THAT(error("cam0: [1]\n"), HasSubstr("camchain.yaml:1: cam0: expected a map of keys"));
}

TEST_F(KalibrChainTest, OtherFilesAreNone) {
  EXPECT_FALSE(is_kalibr_chain(write("name: own\ncameras: []\n")));
  EXPECT_FALSE(is_kalibr_chain(write("[1, 2]\n")));
  EXPECT_NE(error_of([&] { is_kalibr_chain(folder_ / "none.yaml"); }), "");
}

}  // namespace
}  // namespace vinebench::harness
