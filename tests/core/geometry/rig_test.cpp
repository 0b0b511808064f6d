// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "core/util/error.h"
#include "tests/support/test_folder.h"

namespace vinebench {
namespace {

constexpr double kMetreRounding = 1e-14;  // m; a few roundings of numbers about 1

Rig rover() {
  return load_rig(VINEBENCH_SOURCE_DIR "/models/csl-rover/rig.yaml");
}

Pose between(const Rig& rig, const std::string& a, const std::string& b) {
  return rig.cameras.at(static_cast<std::size_t>(rig.find_camera(a))).T_body_cam.inverse() *
         rig.cameras.at(static_cast<std::size_t>(rig.find_camera(b))).T_body_cam;
}

TEST(RigTest, TheRoverHasThePapersLenses) {
  const Rig rig = rover();
  ASSERT_EQ(rig.cameras.size(), 5u);
  EXPECT_EQ(rig.rate_hz, 15);
  for (std::size_t i = 0; i < 4; ++i) {
    const PinholeCamera& lens = rig.cameras[i].model;
    EXPECT_EQ(lens.width, 752);
    EXPECT_EQ(lens.height, 480);
    EXPECT_EQ(lens.fx, 263.2786);
    EXPECT_EQ(lens.fy, 263.2786);
    EXPECT_EQ(lens.cx, 375.5);  // (752 - 1) / 2
    EXPECT_EQ(lens.cy, 239.5);
  }
  EXPECT_EQ(rig.tag_cameras, std::vector<int>{rig.find_camera("side")});
  EXPECT_EQ(rig.find_camera("none"), -1);
}

TEST(RigTest, BaselinesAreTwelveCentimetresAlongTheLeftCamerasXAxis) {
  const Rig rig = rover();
  ASSERT_EQ(rig.stereo_pairs.size(), 2u);
  for (const StereoPair& pair : rig.stereo_pairs) {
    EXPECT_NEAR(rig.baseline(pair), 0.12, kMetreRounding);
    const Pose T_left_right =
        rig.cameras[static_cast<std::size_t>(pair.left)].T_body_cam.inverse() *
        rig.cameras[static_cast<std::size_t>(pair.right)].T_body_cam;
    EXPECT_LT((T_left_right.translation - Eigen::Vector3d(0.12, 0, 0)).norm(), kMetreRounding);
    EXPECT_LT(angle_of(T_left_right.rotation), kMetreRounding);
  }
}

TEST(RigTest, ALensHasItsOwnCoefficients) {
  const test::TestFolder folder;
  const auto rig_with = [&](const std::string& lens) {
    std::ofstream(folder / "rig.yaml") << "cameras:\n  - {name: eye, " << lens << "}\n";
    return load_rig(folder / "rig.yaml").cameras[0].model;
  };
  EXPECT_FALSE(rig_with("fx: 300").has_distortion());
  EXPECT_EQ(rig_with("distortion: [0.1, 0.2, 0, 0, 0.3]").distortion[4], 0.3);
  const PinholeCamera fisheye = rig_with("lens: equidistant, distortion: [0.1, 0.2, 0.3, 0.4]");
  EXPECT_EQ(fisheye.lens, LensModel::kEquidistant);
  EXPECT_EQ(fisheye.distortion[3], 0.4);
  EXPECT_EQ(rig_with("lens: double_sphere, distortion: [-0.2, 0.6]").lens,
            LensModel::kDoubleSphere);
  EXPECT_THROW(rig_with("lens: double_sphere"), Error);  // four zeros are none of its
  EXPECT_THROW(rig_with("distortion: [0.1, 0.2, 0]"), Error);
  EXPECT_THROW(rig_with("lens: equidistant, distortion: [0, 0, 0, 0, 0]"), Error);
}

TEST(RigTest, MaySayTheNoiseOfAnInertialUnit) {
  const test::TestFolder folder;
  const auto rig_with = [&](const std::string& imu) {
    return load_rig(folder.write("rig_test.yaml", "cameras: [{name: a}]\n" + imu));
  };
  EXPECT_FALSE(rig_with("").imu);
  const Rig rig = rig_with(
      "imu:\n  gyroscope: {noise_density: 1.7e-4, bias_random_walk: 2e-5}\n"
      "  accelerometer: {noise_density: 2e-3, bias_random_walk: 3e-3}\n");
  ASSERT_TRUE(rig.imu);
  EXPECT_EQ(rig.imu->gyroscope.bias_random_walk, 2e-5);
  EXPECT_EQ(rig.imu->accelerometer.noise_density, 2e-3);
  // Half of it would leave the filter with noise of zero.
  EXPECT_THAT(test::error_of([&] {
                rig_with("imu: {gyroscope: {noise_density: 1.7e-4, bias_random_walk: 2e-5}}\n");
              }),
              testing::AllOf(testing::HasSubstr("rig_test.yaml:"),
                             testing::HasSubstr("imu: expected noise_density")));
}

TEST(RigTest, TheBackPairLooksTheOppositeWay) {
  // Back-left is 0.30 m behind front-left and 0.12 m to its right; the left and right cameras of
  // the back pair swap sides of the rover.
  const Pose T_front_back = between(rover(), "front_left", "back_left");
  const Eigen::Matrix3d half_turn = Eigen::Vector3d(-1, 1, -1).asDiagonal();
  EXPECT_LT((T_front_back.rotation.toRotationMatrix() - half_turn).norm(), kMetreRounding);
  EXPECT_LT((T_front_back.translation - Eigen::Vector3d(0.12, 0, -0.30)).norm(), kMetreRounding);
}

TEST(RigTest, TheSideCameraLooksRight) {
  // Its x, y and z axes are -z, y and x of front-left.
  const Pose T_front_side = between(rover(), "front_left", "side");
  Eigen::Matrix3d turned;
  turned << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  EXPECT_LT((T_front_side.rotation.toRotationMatrix() - turned).norm(), kMetreRounding);
  EXPECT_LT((T_front_side.translation - Eigen::Vector3d(0.21, 0, -0.09)).norm(), kMetreRounding);
}

TEST(RigTest, AStereoRigLooksAheadFromItsLeftCamera) {
  const Rig rig = Rig::stereo({640, 400, 400, 400, 319.5, 199.5}, 0.12);
  ASSERT_EQ(rig.stereo_pairs.size(), 1u);
  EXPECT_NEAR(rig.baseline(rig.stereo_pairs[0]), 0.12, kMetreRounding);
  // A point 2 m ahead of the left camera is 0.12 m to the left of the right camera's axis.
  const Eigen::Vector3d p_body(2, 0, 0);
  const Pose T_right_body = rig.cameras[1].T_body_cam.inverse();
  EXPECT_LT((rig.cameras[0].T_body_cam.inverse() * p_body - Eigen::Vector3d(0, 0, 2)).norm(),
            kMetreRounding);
  EXPECT_LT((T_right_body * p_body - Eigen::Vector3d(-0.12, 0, 2)).norm(), kMetreRounding);
}

TEST(RigTest, AMountLooksAlongXOfTheBody) {
  const Pose T_body_cam = Rig::mount({1, 2, 3}, {0, 0, 0});
  EXPECT_LT((T_body_cam * Eigen::Vector3d::UnitZ() - Eigen::Vector3d(2, 2, 3)).norm(),
            kMetreRounding);
  EXPECT_LT((T_body_cam * Eigen::Vector3d::UnitX() - Eigen::Vector3d(1, 1, 3)).norm(),
            kMetreRounding);
  EXPECT_LT((T_body_cam * Eigen::Vector3d::UnitY() - Eigen::Vector3d(1, 2, 2)).norm(),
            kMetreRounding);
  // Pitched by 30 degrees it looks down.
  const Pose pitched = Rig::mount({0, 0, 0}, {0, std::numbers::pi / 6, 0});
  EXPECT_NEAR((pitched * Eigen::Vector3d::UnitZ()).z(), -0.5, kMetreRounding);
}

TEST(RigTest, UnknownNamesAreErrorsWithFileAndKey) {
  const test::TestFolder folder;
  const auto error_of = [&](const std::string& text) {
    return test::error_of([&] { load_rig(folder.write("rig_test.yaml", text)); });
  };
  const std::string cameras = "cameras:\n  - {name: a}\n  - {name: b}\n";
  EXPECT_THAT(error_of(cameras + "stereo_pairs:\n  - {name: p, left: a, right: c}\n"),
              testing::AllOf(testing::HasSubstr("rig_test.yaml:"),
                             testing::HasSubstr("stereo_pairs.0"), testing::HasSubstr("'c'")));
  EXPECT_THAT(error_of(cameras + "tag_cameras: [a, d]\n"),
              testing::AllOf(testing::HasSubstr("tag_cameras.1"), testing::HasSubstr("'d'")));
  EXPECT_THAT(error_of("name: empty\n"), testing::HasSubstr("expected at least one camera"));
  EXPECT_THAT(error_of(cameras + "  - {name: a}\n"),
              testing::AllOf(testing::HasSubstr("cameras.2"), testing::HasSubstr("'a' is taken")));
  std::string many = "cameras:\n";
  for (int i = 0; i < 65; ++i) many += fmt::format("  - {{name: c{}}}\n", i);
  EXPECT_THAT(error_of(many), testing::HasSubstr("expected at most 64 cameras, found 65"));
  EXPECT_EQ(error_of(cameras), "");
}

// Images are written to files and folders of these names.
TEST(RigTest, ACamerasNameIsNoPath) {
  const test::TestFolder folder;
  for (const char* name : {"../../front", "/tmp/front", "..", "front/left"}) {
    const auto file = folder.write("rig_test.yaml", fmt::format("cameras: [{{name: {}}}]\n", name));
    EXPECT_THAT(test::error_of([&] { load_rig(file); }),
                testing::HasSubstr(fmt::format("camera '{}': expected a name without '/'", name)));
  }
}

TEST(RigTest, AConfigMadeInCodeIsCheckedToo) {
  RigConfig config;
  config.name = "mine";
  config.cameras.resize(1);
  config.cameras[0].name = "camera";
  config.tag_cameras = {"nose"};
  EXPECT_THAT([&] { config.make(); },
              testing::ThrowsMessage<Error>(
                  testing::AllOf(testing::HasSubstr("'mine'"), testing::HasSubstr("'nose'"))));
}

}  // namespace
}  // namespace vinebench
