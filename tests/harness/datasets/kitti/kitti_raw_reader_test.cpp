// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_raw_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/recorded_folders.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;
using testing::IsEmpty;
using Counts = std::map<std::string, int>;

// Cameras 0.5 m apart; as they are, the right one is turned by a quarter about the optical axis and
// has a lens; rectified images are two pixels smaller on each side. The unit is 1 m above camera 0,
// with x ahead, y left, z up; the scanner is where the unit is.
constexpr const char* kCameras =
    "calib_time: 09-Jan-2012 13:57:47\n"
    "corner_dist: 9.950000e-02\n"
    "S_00: 3.600000e+01 2.800000e+01\n"
    "K_00: 20 0 17 0 21 13 0 0 1\n"
    "D_00: -0.3 0.1 0.001 0.002 -0.01\n"
    "R_00: 1 0 0 0 1 0 0 0 1\n"
    "T_00: 0 0 0\n"
    "S_rect_00: 32 24\n"
    "R_rect_00: 1 0 0 0 1 0 0 0 1\n"
    "P_rect_00: 20 0 15 0 0 20 11 0 0 0 1 0\n"
    "S_01: 36 28\n"
    "K_01: 22 0 17 0 22 13 0 0 1\n"
    "D_01: 0 0 0 0 0\n"
    "R_01: 0 1 0 -1 0 0 0 0 1\n"
    "T_01: 0 0.5 0\n"
    "S_rect_01: 32 24\n"
    "R_rect_01: 1 0 0 0 1 0 0 0 1\n"
    "P_rect_01: 20 0 15 -10 0 20 11 0 0 0 1 0\n";

std::string stamp_text(int milliseconds) {
  return fmt::format("2011-09-26 13:02:{:02}.{:03}000001\n", 25 + milliseconds / 1000,
                     milliseconds % 1000);
}

/// 25 numbers and the receiver's five: `north` degrees off the equator, 1 m a reading up.
std::string oxts_line(int number, double north) {
  return fmt::format(
      "{} 8.5 {} 0 0 0 0 0 0 0 0 0.5 0.25 9.81 0 0 0 0.1 0.2 0.3 0 0 0 0.05 0.1 "
      "4 9 4 4 0\n",
      north * number, 100 + number);
}

class KittiRawReaderTest : public testing::Test {
 protected:
  KittiRawReaderTest() {
    test::write_text(day_ / "calib_cam_to_cam.txt", kCameras);
    test::write_text(day_ / "calib_imu_to_velo.txt",
                     "calib_time: 25-May-2012 16:47:16\nR: 1 0 0 0 1 0 0 0 1\nT: 0 0 0\n");
    // x right = -y left, y down = -z up and a metre of it, z ahead = x ahead.
    test::write_text(day_ / "calib_velo_to_cam.txt",
                     "calib_time: 15-Mar-2012 11:37:16\nR: 0 -1 0 0 0 -1 1 0 0\nT: 0 -1 0\n"
                     "delta_f: 0 0\ndelta_c: 0 0\n");
    for (int camera = 0; camera < 2; ++camera) write_camera(camera);
    write_oxts(5, 100);
  }

  void write_camera(int camera, cv::Size size = {test::kWidth, test::kHeight}) {
    const auto folder = drive_ / fmt::format("image_{:02}", camera);
    std::string stamps;
    for (int i = 0; i < 5; ++i) {
      test::write_image(folder / fmt::format("data/{:010}.png", i),
                        cv::Mat(size, CV_8UC1, cv::Scalar(20 * camera + i)));
      stamps += stamp_text(100 * i);
    }
    test::write_text(folder / "timestamps.txt", stamps);
  }

  void write_oxts(int count, int milliseconds) {
    std::string stamps;
    for (int i = 0; i < count; ++i) {
      test::write_text(drive_ / fmt::format("oxts/data/{:010}.txt", i), oxts_line(i, 1e-5));
      stamps += stamp_text(milliseconds * i);
    }
    test::write_text(drive_ / "oxts/timestamps.txt", stamps);
  }

  test::TestFolder folder_;
  std::filesystem::path day_ = folder_ / "2011_09_26";
  std::filesystem::path drive_ = day_ / "2011_09_26_drive_0001_sync";
};

TEST_F(KittiRawReaderTest, RectifiedImagesHaveTheRectifiedCalibration) {
  const Recording recording = open_recording(drive_);
  EXPECT_EQ(recording.format, "KITTI raw");
  EXPECT_EQ(recording.name, "2011_09_26_drive_0001_sync");
  ASSERT_EQ(recording.frames.size(), 5u);
  EXPECT_NEAR(recording.rig.rate_hz, 10, 1e-9);
  EXPECT_EQ(recording.frames[1].stamp - recording.frames[0].stamp, 100'000'000);
  const auto& [left, right] = std::tie(recording.rig.cameras.at(0), recording.rig.cameras.at(1));
  EXPECT_EQ(left.model.width, 32);
  EXPECT_EQ(left.model.fx, 20);
  EXPECT_FALSE(left.model.has_distortion());
  // The body is the unit: camera 0 is 1 m below it and looks ahead; 10 / 20 m to its right is 1.
  EXPECT_LT((left.T_body_cam.translation - Eigen::Vector3d(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((left.T_body_cam.rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(),
            1e-12);
  EXPECT_LT((right.T_body_cam.translation - Eigen::Vector3d(0, -0.5, -1)).norm(), 1e-12);
}

TEST_F(KittiRawReaderTest, OtherImagesHaveTheirOwnLensesAndPlaces) {
  write_camera(0, {36, 28});
  write_camera(1, {36, 28});
  const Recording recording = open_recording(drive_);
  const auto& [left, right] = std::tie(recording.rig.cameras.at(0), recording.rig.cameras.at(1));
  EXPECT_EQ(left.model.width, 36);
  EXPECT_EQ(left.model.fy, 21);
  EXPECT_EQ(left.model.coefficients(), (std::vector<double>{-0.3, 0.1, 0.001, 0.002, -0.01}));
  // x_1 = R x_0 + t is 0 for x_0 = -R^T t = (0.5, 0, 0): half a metre to the right of camera 0.
  EXPECT_LT((right.T_body_cam.translation - Eigen::Vector3d(0, -0.5, -1)).norm(), 1e-12);
  // Its x axis is R^T (1, 0, 0) = (0, 1, 0) of camera 0, which is down: -z of the body.
  EXPECT_LT(
      (right.T_body_cam.rotation * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitZ()).norm(),
      1e-12);
}

TEST_F(KittiRawReaderTest, TheUnitTellsTheTruth) {
  const std::vector<Sample> samples = test::play_all(drive_);
  ASSERT_EQ(samples.size(), 5u);
  EXPECT_THAT(test::count_events(samples), IsEmpty());
  EXPECT_EQ(test::grey_of(samples[3].frame.images[1]), 23);
  // On the equator a degree of latitude is pi / 180 of 6378137 m on Mercator's map.
  const double metres = 3e-5 * std::numbers::pi / 180 * 6378137;
  ASSERT_TRUE(samples[3].truth.known);
  EXPECT_LT((samples[3].truth.T_world_body.translation - Eigen::Vector3d(0, metres, 3)).norm(),
            1e-6);
  EXPECT_EQ(samples[0].truth.T_world_body.translation.norm(), 0);
}

TEST_F(KittiRawReaderTest, ReadingsOfEachFrameAloneAreNoInertialUnit) {
  EXPECT_THAT(open_recording(drive_).imu, IsEmpty());
  write_oxts(41, 10);  // 100 Hz, as in drives that are not synchronised
  const Recording recording = open_recording(drive_);
  ASSERT_EQ(recording.imu.size(), 41u);
  EXPECT_LT((recording.imu[1].specific_force - Eigen::Vector3d(0.5, 0.25, 9.81)).norm(), 1e-12);
  EXPECT_LT((recording.imu[1].angular_velocity - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-12);
  EXPECT_EQ(recording.imu[1].stamp - recording.frames[0].stamp, 10'000'000);
}

TEST_F(KittiRawReaderTest, WithoutTheUnitsPlaceTheBodyIsCamera0) {
  std::filesystem::remove(day_ / "calib_imu_to_velo.txt");
  const Recording recording = open_recording(drive_);
  EXPECT_THAT(recording.truth, IsEmpty());
  EXPECT_LT(recording.rig.cameras[0].T_body_cam.translation.norm(), 1e-15);
}

TEST_F(KittiRawReaderTest, TheTruthIsOfAnotherRigsBodyToo) {
  const auto rig = folder_.write(
      "chain.yaml", test::kalibr_camera("cam0", 0) + test::kalibr_camera("cam1", -0.5));
  const Recording recording = open_recording(drive_, {.rig = rig, .groundtruth = {}});
  EXPECT_NEAR(recording.rig.rate_hz, 10, 1e-9);
  // The body is at the left camera, with the unit's axes, and so 1 m below the unit.
  ASSERT_EQ(recording.truth.size(), 5u);
  EXPECT_LT((recording.truth[0].pose.translation - Eigen::Vector3d(0, 0, -1)).norm(), 1e-12);
}

TEST_F(KittiRawReaderTest, ADriveMayHaveItsCalibrationBesideItsImages) {
  for (const char* name :
       {"calib_cam_to_cam.txt", "calib_velo_to_cam.txt", "calib_imu_to_velo.txt"}) {
    std::filesystem::rename(day_ / name, drive_ / name);
  }
  EXPECT_EQ(open_recording(drive_).truth.size(), 5u);
}

TEST_F(KittiRawReaderTest, ColourIsReadWhereThereIsNoGrey) {
  std::string text = kCameras;
  for (const char* digit : {"_00:", "_01:"}) {
    for (auto at = text.find(digit); at != std::string::npos; at = text.find(digit)) {
      text[at + 2] = static_cast<char>(text[at + 2] + 2);
    }
  }
  test::write_text(day_ / "calib_cam_to_cam.txt", text + "R_rect_00: 1 0 0 0 1 0 0 0 1\n");
  std::filesystem::rename(drive_ / "image_00", drive_ / "image_02");
  std::filesystem::rename(drive_ / "image_01", drive_ / "image_03");
  EXPECT_NEAR(open_recording(drive_).rig.baseline({"front", 0, 1}), 0.5, 1e-12);
}

TEST_F(KittiRawReaderTest, AMissingImageIsABlindCamera) {
  std::filesystem::remove(drive_ / "image_01/data/0000000002.png");
  const std::vector<Sample> samples = test::play_all(drive_);
  ASSERT_EQ(samples.size(), 5u);
  EXPECT_TRUE(samples[2].frame.images[1].empty());
  EXPECT_EQ(test::count_events(samples), (Counts{{"picture_missing", 1}}));
}

TEST_F(KittiRawReaderTest, WithoutStampsTheRateIsTheCameras) {
  for (const char* camera : {"image_00", "image_01"}) {
    std::filesystem::remove(drive_ / camera / "timestamps.txt");
  }
  std::filesystem::remove_all(drive_ / "oxts");
  EXPECT_EQ(open_recording(drive_).frames[3].stamp, 300'000'000);
}

TEST_F(KittiRawReaderTest, OtherLinesOfTheCalibrationAreIgnored) {
  test::write_text(day_ / "calib_cam_to_cam.txt", std::string(", 1\nno name\n:\n") + kCameras);
  EXPECT_EQ(open_recording(drive_).frames.size(), 5u);
}

TEST_F(KittiRawReaderTest, WhatCannotBeUsedIsAnError) {
  const auto expect_error = [&](const char* from, const char* to, const char* message) {
    std::string text = kCameras;
    text.replace(text.find(from), std::string(from).size(), to);
    test::write_text(day_ / "calib_cam_to_cam.txt", text);
    EXPECT_THAT(error_of([&] { open_recording(drive_); }), HasSubstr(message));
    test::write_text(day_ / "calib_cam_to_cam.txt", kCameras);
  };
  expect_error("S_rect_00: 32 24", "S_rect_00: 40 24",
               "calib_cam_to_cam.txt:3: S_00: expected images of 36 x 28 (as they are) or 40 x 24 "
               "(rectified), found 32 x 24");
  expect_error("P_rect_01: 20", "P_rect_01: -20", "calib_cam_to_cam.txt:18: P_rect_01:");
  expect_error("P_rect_01", "P_rect_07", "calib_cam_to_cam.txt: expected a line P_rect_01:");
  expect_error("R_rect_00: 1", "R_rect_00: 2", "R_rect_00: expected a rotation matrix");
  expect_error("S_00: 3.600000e+01", "S_00: ten", "expected a number, found 'ten'");
  test::write_text(drive_ / "image_00/timestamps.txt", stamp_text(0));
  EXPECT_THAT(error_of([&] { open_recording(drive_); }),
              HasSubstr("image_00/timestamps.txt: expected a line for 0000000001.png, found 1"));
}

}  // namespace
}  // namespace vinebench::harness
