// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/sensors/calibration_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

using testing::HasSubstr;

Rig many_cameras(int count) {
  Rig rig;
  rig.name = "test";
  for (int i = 0; i < count; ++i) {
    const PinholeCamera model{752, 480, 263.2786, 263.2786, 375.5, 239.5, {}};
    rig.cameras.push_back(
        {fmt::format("camera_{}", i), model, Rig::mount({0.1 * i, 0, 0.5}, {0, 0, 0.3})});
  }
  return rig;
}

TEST(CalibrationErrorTest, NoneIsTheSameRigToTheBit) {
  const Rig told = many_cameras(3);
  const Rig rig = true_rig(told, {}, 7);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rig.cameras[i].T_body_cam.matrix(), told.cameras[i].T_body_cam.matrix());
    EXPECT_EQ(rig.cameras[i].model.fx, told.cameras[i].model.fx);
    EXPECT_EQ(rig.cameras[i].model.cy, told.cameras[i].model.cy);
    EXPECT_FALSE(rig.cameras[i].model.has_distortion());
  }
}

TEST(CalibrationErrorTest, DrawsHaveTheirDeviations) {
  const Rig told = many_cameras(600);
  CalibrationErrorConfig config;
  config.position = 0.002;
  config.rotation_deg = 0.1;
  config.focal_px = 0.5;
  config.principal_point_px = 0.3;
  const Rig rig = true_rig(told, config, 1);
  double position = 0, rotation = 0, focal = 0, principal = 0;
  for (std::size_t i = 0; i < 600; ++i) {
    const Pose error = told.cameras[i].T_body_cam.inverse() * rig.cameras[i].T_body_cam;
    position += error.translation.squaredNorm() / 1800;
    rotation += log_so3(error.rotation).squaredNorm() / 1800;
    focal += std::pow(rig.cameras[i].model.fx - told.cameras[i].model.fx, 2) / 600;
    principal += std::pow(rig.cameras[i].model.cx - told.cameras[i].model.cx, 2) / 600;
  }
  // The deviation of 600 or 1800 draws is known to 1 / sqrt(1200) = 2.9 % or 1.7 %; 3.5 of those.
  EXPECT_NEAR(std::sqrt(position), 0.002, 0.06 * 0.002);
  EXPECT_NEAR(std::sqrt(rotation), 0.1 * std::numbers::pi / 180,
              0.06 * 0.1 * std::numbers::pi / 180);
  EXPECT_NEAR(std::sqrt(focal), 0.5, 0.1 * 0.5);
  EXPECT_NEAR(std::sqrt(principal), 0.3, 0.1 * 0.3);
}

TEST(CalibrationErrorTest, AFixedErrorIsAddedToOneCamera) {
  const Rig told = many_cameras(2);
  CalibrationErrorConfig config;
  CalibrationErrorConfig::Camera error;
  error.name = "camera_1";
  error.position = {0.01, 0, 0};
  error.rotation_deg = {0, 2, 0};
  error.principal_point_px = {3, -4};
  error.distortion = {-0.1, 0, 0, 0};
  config.cameras = {error};
  const Rig rig = true_rig(told, config, 1);
  EXPECT_EQ(rig.cameras[0].T_body_cam.matrix(), told.cameras[0].T_body_cam.matrix());
  const Pose difference = told.cameras[1].T_body_cam.inverse() * rig.cameras[1].T_body_cam;
  EXPECT_NEAR((difference.translation - Eigen::Vector3d(0.01, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(angle_of(difference.rotation), 2 * std::numbers::pi / 180, 1e-9);
  EXPECT_DOUBLE_EQ(rig.cameras[1].model.cx, 378.5);
  EXPECT_DOUBLE_EQ(rig.cameras[1].model.cy, 235.5);
  EXPECT_EQ(rig.cameras[1].model.distortion[0], -0.1);
}

TEST(CalibrationErrorTest, NonsenseIsRefused) {
  CalibrationErrorConfig config;
  config.cameras.resize(1);
  config.cameras[0].name = "nobody";
  EXPECT_THAT(test::error_of([&] { true_rig(many_cameras(1), config, 1); }), HasSubstr("'nobody'"));
  config.cameras[0].name = "camera_0";
  config.cameras[0].focal_px = {-300, 0};
  EXPECT_THAT(test::error_of([&] { true_rig(many_cameras(1), config, 1); }),
              HasSubstr("expected above 0"));
}

}  // namespace
}  // namespace vinebench::sim
