// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/rig_settings.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core/persistence.hpp>

#include "core/config/yaml.h"

namespace vinebench::harness {
namespace {

/// Two pairs and a side camera, back pair turned to the rear.
class RigSettingsTest : public testing::Test {
 protected:
  RigSettingsTest() {
    notes_.rig =
        YamlDocument::load(std::string(VINEBENCH_SOURCE_DIR) + "/models/csl-rover/rig.yaml")
            .read<RigConfig>();
    notes_.imu.gyroscope = {0.002, 0.0001};
    notes_.imu.accelerometer = {0.03, 0};  // no walk: other systems would divide by it
    rig_ = notes_.rig.make();
    for (const SettingsFile& file : rig_settings(rig_, notes_)) files_[file.name] = file.text;
  }

  /// Without OpenCV's directive, which is none of YAML's.
  YAML::Node yaml(const std::string& name) const {
    return YAML::Load(files_.at(name).substr(std::string("%YAML:1.0\n").size()));
  }

  RecordingNotes notes_;
  Rig rig_;
  std::map<std::string, std::string> files_;
};

TEST_F(RigSettingsTest, Okvis2HasEveryCamera) {
  const YAML::Node settings = yaml("okvis2.yaml");
  ASSERT_EQ(settings["cameras"].size(), rig_.cameras.size());
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
    const YAML::Node camera = settings["cameras"][i];
    const RigCamera& expected = rig_.cameras[i];
    EXPECT_EQ(camera["T_SC"].size(), 16u);
    EXPECT_DOUBLE_EQ(camera["T_SC"][7].as<double>(), expected.T_body_cam.translation.y());
    EXPECT_EQ(camera["image_dimension"][0].as<int>(), expected.model.width);
    EXPECT_DOUBLE_EQ(camera["focal_length"][1].as<double>(), expected.model.fy);
  }
  EXPECT_EQ(settings["camera_parameters"]["sync_cameras"].size(), rig_.cameras.size());
  EXPECT_DOUBLE_EQ(settings["imu_parameters"]["sigma_g_c"].as<double>(), 0.002);
  EXPECT_GT(settings["imu_parameters"]["sigma_aw_c"].as<double>(), 0);
}

TEST_F(RigSettingsTest, EdexHasThePairsInOpenGlsAxes) {
  const auto edex = nlohmann::json::parse(files_.at("stereo.edex"));
  const auto& cameras = edex[0]["cameras"];
  ASSERT_EQ(cameras.size(), 4u);
  // The left camera is the frame; the right one stands a baseline to its right.
  const double baseline =
      (rig_.cameras[1].T_body_cam.translation - rig_.cameras[0].T_body_cam.translation).norm();
  const Eigen::Matrix<double, 3, 4> identity = Eigen::Matrix<double, 3, 4>::Identity();
  const auto matrix = [&](std::size_t camera) {
    Eigen::Matrix<double, 3, 4> m;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        m(row, column) = cameras[camera]["transform"][row][column].get<double>();
      }
    }
    return m;
  };
  EXPECT_LT((matrix(0) - identity).norm(), 1e-12);
  Eigen::Matrix<double, 3, 4> right = identity;
  right(0, 3) = baseline;
  EXPECT_LT((matrix(1) - right).norm(), 1e-9);
  // As its readers turn it: x right, y down, z ahead. The back pair looks the other way.
  const Eigen::DiagonalMatrix<double, 3> flip(1, -1, -1);
  const Pose expected = rig_.cameras[0].T_body_cam.inverse() * rig_.cameras[2].T_body_cam;
  const Eigen::Matrix3d R = flip * matrix(2).leftCols<3>() * flip;
  EXPECT_LT((R - expected.rotation.toRotationMatrix()).norm(), 1e-12);
  EXPECT_LT((flip * matrix(2).col(3) - expected.translation).norm(), 1e-12);
  EXPECT_EQ(cameras[0]["intrinsics"]["focal"][0], rig_.cameras[0].model.fx);
  EXPECT_EQ(cameras[0]["intrinsics"]["size"], nlohmann::json({752, 480}));
}

TEST_F(RigSettingsTest, EdexWritesBrownsCoefficientsInItsOwnOrder) {
  rig_.cameras[0].model.distortion = {0.1, 0.2, 0.3, 0.4};
  const auto edex = nlohmann::json::parse(edex_settings(rig_));
  const auto& intrinsics = edex[0]["cameras"][0]["intrinsics"];
  EXPECT_EQ(intrinsics["distortion_model"], "brown");
  EXPECT_EQ(intrinsics["distortion_params"], nlohmann::json({0.1, 0.2, 0.0, 0.3, 0.4}));
}

TEST_F(RigSettingsTest, KalibrsChainJoinsEachCameraToTheOneBefore) {
  const cv::FileStorage chain(files_.at("kalibr_imucam_chain_rig.yaml"),
                              cv::FileStorage::READ | cv::FileStorage::MEMORY);
  ASSERT_TRUE(chain.isOpened());
  const auto matrix = [](const cv::FileNode& rows) {
    Eigen::Matrix4d m;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column) m(row, column) = double(rows[row][column]);
    }
    return m;
  };
  for (std::size_t i = 1; i < rig_.cameras.size(); ++i) {
    const cv::FileNode before = chain[fmt::format("cam{}", i - 1)];
    const cv::FileNode camera = chain[fmt::format("cam{}", i)];
    const Eigen::Matrix4d joined = matrix(camera["T_cn_cnm1"]) * matrix(before["T_cam_imu"]);
    // Products of numbers of one: rounding.
    EXPECT_LT((joined - matrix(camera["T_cam_imu"])).norm(), 1e-12) << i;
  }
  // Cameras of a pair see the same, and no other.
  for (const StereoPair& pair : rig_.stereo_pairs) {
    const cv::FileNode overlaps = chain[fmt::format("cam{}", pair.left)]["cam_overlaps"];
    ASSERT_EQ(overlaps.size(), 1u);
    EXPECT_EQ(int(overlaps[0]), pair.right);
  }
}

TEST_F(RigSettingsTest, BasaltHasEveryCamera) {
  const auto value = nlohmann::json::parse(files_.at("basalt_calib_rig.json"))["value0"];
  EXPECT_EQ(value["T_imu_cam"].size(), rig_.cameras.size());
  EXPECT_EQ(value["intrinsics"].size(), rig_.cameras.size());
  EXPECT_EQ(value["gyro_noise_std"], (nlohmann::json{0.002, 0.002, 0.002}));
}

TEST_F(RigSettingsTest, OpenVinsHasPairsFirst) {
  Rig rig = rig_;
  // A side camera before the pairs.
  std::rotate(rig.cameras.begin(), rig.cameras.end() - 1, rig.cameras.end());
  for (StereoPair& pair : rig.stereo_pairs) ++pair.left, ++pair.right;
  std::string text;
  for (const SettingsFile& file : rig_settings(rig, notes_)) {
    if (file.name == "openvins_imucam_chain.yaml") text = file.text;
  }
  const cv::FileStorage chain(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(int(chain[fmt::format("cam{}", i)]["resolution"][0]), 752) << i;
  }
  EXPECT_EQ(int(chain["cam4"]["resolution"][0]), 1920);
  EXPECT_EQ(yaml("openvins.yaml")["max_cameras"].as<int>(), 5);
  EXPECT_EQ(yaml("openvins.yaml")["relative_config_imucam"].as<std::string>(),
            "openvins_imucam_chain.yaml");
}

}  // namespace
}  // namespace vinebench::harness
