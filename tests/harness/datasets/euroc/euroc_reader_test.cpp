// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/yaml_writer.h"
#include "harness/datasets/reading/sensor_file.h"
#include "tests/support/broken_png.h"
#include "tests/support/recorded_folders.h"
#include "tests/support/special_files.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using test::kFirstStamp;
using test::kPeriod;
using testing::HasSubstr;
using Counts = std::map<std::string, int>;

class EurocReaderTest : public testing::Test {
 protected:
  void expect_error(const std::string& what) {
    EXPECT_THAT(error_of([&] { open_recording(root_); }), HasSubstr(what));
  }
  void set_sensor(const std::string& camera, const std::string& text) {
    test::write_text(root_ / "mav0" / camera / "sensor.yaml", text);
  }
  std::string edited(const std::string& from, const std::string& to) {
    std::string text = test::sensor_yaml(0);
    return text.replace(text.find(from), from.size(), to);
  }

  test::TestFolder folder_;
  std::filesystem::path root_ = test::write_euroc(folder_);
};

TEST_F(EurocReaderTest, ReadsCamerasAndFrames) {
  for (const auto& named : {root_, root_ / "mav0"}) {
    const Recording recording = open_recording(named);
    EXPECT_EQ(recording.name, "euroc");
    EXPECT_EQ(recording.rig.rate_hz, 20);
    ASSERT_EQ(recording.frames.size(), 5u);
    EXPECT_EQ(recording.frames[4].stamp, kFirstStamp + 4 * kPeriod);
    ASSERT_EQ(recording.rig.cameras.size(), 2u);
    EXPECT_EQ(recording.rig.cameras[0].model.cx, 15);
    EXPECT_NEAR(recording.rig.baseline(recording.rig.stereo_pairs[0]), 0.1, 1e-15);
    const Pose ahead = Rig::mount({0, -0.1, 0}, {0, 0, 0});
    const Pose difference = ahead.inverse() * recording.rig.cameras[1].T_body_cam;
    EXPECT_LT((difference.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
  }
}

// TUM-VI: no sensor.yaml, but a chain of Kalibr beside mav0, and motion capture.
TEST_F(EurocReaderTest, ACalibrationOfKalibrIsRead) {
  for (const char* camera : {"cam0", "cam1"}) {
    std::filesystem::remove(root_ / "mav0" / camera / "sensor.yaml");
  }
  std::filesystem::rename(root_ / "mav0/state_groundtruth_estimate0", root_ / "mav0/mocap0");
  test::write_text(root_ / "dso/camchain.yaml",
                   test::kalibr_camera("cam0", 0) + test::kalibr_camera("cam1", -0.1));
  test::write_text(root_ / "dso/imu_config.yaml",
                   "update_rate: 200.0\naccelerometer_noise_density: 0.0028\n"
                   "accelerometer_random_walk: 0.00086\ngyroscope_noise_density: 0.00016\n"
                   "gyroscope_random_walk: 0.000022\n");
  const Recording recording = open_recording(root_);
  EXPECT_NEAR(recording.rig.rate_hz, 20, 1e-9);
  EXPECT_EQ(recording.rig.cameras.at(1).model.lens, LensModel::kEquidistant);
  EXPECT_NEAR(recording.rig.baseline(recording.rig.stereo_pairs.at(0)), 0.1, 1e-12);
  ASSERT_TRUE(recording.rig.imu);
  EXPECT_EQ(recording.rig.imu->gyroscope.bias_random_walk, 0.000022);
  EXPECT_FALSE(recording.truth.empty());
}

// By the unit's clock the images are taken 20 ms later: each frame has four readings more before
// it.
TEST_F(EurocReaderTest, KalibrsShiftStampsImagesByTheUnitsClock) {
  const std::string shift = "  timeshift_cam_imu: 0.02\n";
  test::write_text(root_ / "dso/camchain.yaml", test::kalibr_camera("cam0", 0) + shift +
                                                    test::kalibr_camera("cam1", -0.1) + shift);
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), 5u);
  EXPECT_EQ(samples[0].frame.stamp, test::kFirstStamp + 20'000'000);
  EXPECT_EQ(samples[0].frame.imu.size(), 5u);
  EXPECT_TRUE(samples[0].frame.image_stamps.empty());
  EXPECT_LT((samples[1].truth.T_world_body.translation - Eigen::Vector3d(0.07, 2, 3)).norm(), 1e-6);
}

TEST_F(EurocReaderTest, TheUnitsFileSaysItsNoise) {
  EXPECT_FALSE(open_recording(root_).rig.imu);  // there is none
  const std::string lines =
      "sensor_type: imu\nT_BS:\n  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n"
      "gyroscope_noise_density: 1.7e-4\ngyroscope_random_walk: 2e-5\n"
      "accelerometer_noise_density: 2e-3\n";
  set_sensor("imu0", lines + "accelerometer_random_walk: 3e-3\n");
  const std::optional<ImuNoise> noise = open_recording(root_).rig.imu;
  ASSERT_TRUE(noise);
  EXPECT_EQ(noise->gyroscope.noise_density, 1.7e-4);
  EXPECT_EQ(noise->gyroscope.bias_random_walk, 2e-5);
  EXPECT_EQ(noise->accelerometer.noise_density, 2e-3);
  EXPECT_EQ(noise->accelerometer.bias_random_walk, 3e-3);
  for (const char* walk : {"", "accelerometer_random_walk: 0\n"}) {
    set_sensor("imu0", lines + walk);  // 0: of one that somebody made up
    EXPECT_FALSE(open_recording(root_).rig.imu);
  }
}

TEST_F(EurocReaderTest, GivesImagesReadingsAndInterpolatedTruth) {
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), 5u);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(test::grey_of(samples[i].frame.images[0]), int(i));
    EXPECT_EQ(test::grey_of(samples[i].frame.images[1]), 20 + int(i));
    // 10 readings a frame; the first frame gets the one at its own stamp.
    EXPECT_EQ(samples[i].frame.imu.size(), i == 0 ? 1u : 10u);
    EXPECT_TRUE(samples[i].events.empty());
    // 1 m/s: true poses are 3 ms after and 7 ms before the frame's stamp.
    ASSERT_TRUE(samples[i].truth.known);
    const Eigen::Vector3d expected(0.05 * double(i), 2, 3);
    EXPECT_LT((samples[i].truth.T_world_body.translation - expected).norm(), 1e-6);
  }
  EXPECT_EQ(samples[1].frame.imu[0].angular_velocity, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(samples[1].frame.imu[0].specific_force, Eigen::Vector3d(1, 0, 9.81));
}

TEST_F(EurocReaderTest, ReadingsAreTurnedIntoTheBodyFrame) {
  // The unit's x is the body's y.
  test::write_text(root_ / "mav0/imu0/sensor.yaml",
                   "%YAML:1.0\nT_BS: {cols: 4, rows: 4, data: "
                   "[0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}\n");
  const ImuSample reading = open_recording(root_).imu.at(2);
  EXPECT_LT((reading.specific_force - Eigen::Vector3d(0, 2, 9.81)).norm(), 1e-12);
  EXPECT_LT((reading.angular_velocity - Eigen::Vector3d(-0.2, 0.1, 0.3)).norm(), 1e-12);
}

TEST_F(EurocReaderTest, MotionCaptureIsTheTruthWhereThereIsNoOther) {
  std::filesystem::remove_all(root_ / "mav0/state_groundtruth_estimate0");
  EXPECT_FALSE(test::play_all(root_).at(0).truth.known);
  // The markers are 0.5 m above the body.
  test::write_text(root_ / "mav0/vicon0/data.csv",
                   fmt::format("#t\n{},1,2,3,1,0,0,0\n", kFirstStamp));
  test::write_text(root_ / "mav0/vicon0/sensor.yaml",
                   "T_BS: {data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 1]}\n");
  const Truth truth = test::play_all(root_).at(0).truth;
  EXPECT_TRUE(truth.known);
  EXPECT_LT((truth.T_world_body.translation - Eigen::Vector3d(1, 2, 2.5)).norm(), 1e-12);
}

TEST_F(EurocReaderTest, StampsOutOfOrderAndTwiceAreMendedAndTold) {
  const std::string list =
      fmt::format("{0},{0}.png\n{1},{1}.png\n{2},{2}.png\n{1},{1}.png\n{3},{3}.png\n", kFirstStamp,
                  kFirstStamp + 2 * kPeriod, kFirstStamp + kPeriod, kFirstStamp + 3 * kPeriod);
  test::write_text(root_ / "mav0/cam0/data.csv", list);
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(test::grey_of(samples[i].frame.images[0]), int(i));
  // cam1's fifth image no longer has a frame.
  EXPECT_EQ(test::count_events(samples),
            (Counts{{"stamp_out_of_order", 1}, {"stamp_repeated", 1}, {"picture_unmatched", 1}}));
}

TEST_F(EurocReaderTest, CamerasWithStampsOfTheirOwnAreAssociated) {
  std::vector<std::int64_t> stamps = test::regular_stamps(5);
  for (std::int64_t& stamp : stamps) stamp += kPeriod / 5;
  stamps.erase(stamps.begin() + 2);
  stamps.insert(stamps.begin() + 1, stamps[0] + kPeriod / 5);  // an additional one between 0 and 1
  test::write_euroc_camera(root_, 1, stamps);
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), 5u);
  EXPECT_EQ(test::grey_of(samples[0].frame.images[1]), 20);
  EXPECT_EQ(test::grey_of(samples[1].frame.images[1]), 22);
  EXPECT_TRUE(samples[2].frame.images[1].empty());
  EXPECT_EQ(test::grey_of(samples[3].frame.images[1]), 23);
  EXPECT_EQ(test::count_events(samples),
            (Counts{{"picture_missing", 1}, {"picture_unmatched", 1}, {"stamps_differ", 1}}));
  EXPECT_THAT(samples[0].events.at(0).detail + samples[0].events.back().detail,
              HasSubstr("in 4 frames, by 10.000 ms at most"));
  EXPECT_EQ(samples[1].frame.stamp, kFirstStamp + kPeriod);
  EXPECT_EQ(samples[1].frame.image_stamp(0), kFirstStamp + kPeriod);
  EXPECT_EQ(samples[1].frame.image_stamp(1), kFirstStamp + kPeriod + kPeriod / 5);
}

TEST_F(EurocReaderTest, AGapIsTold) {
  std::vector<std::int64_t> stamps = test::regular_stamps(12);
  stamps.erase(stamps.begin() + 6, stamps.begin() + 9);
  for (int camera = 0; camera < 2; ++camera) test::write_euroc_camera(root_, camera, stamps);
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), 9u);
  ASSERT_FALSE(samples[6].events.empty());
  EXPECT_EQ(samples[6].events[0].event, "frames_missing");
  EXPECT_THAT(samples[6].events[0].detail, HasSubstr("about 3 frames"));
}

TEST_F(EurocReaderTest, MissingAndDamagedImagesAreBlindCameras) {
  const std::vector<std::int64_t> stamps = test::regular_stamps(5);
  const auto image = [&](int camera, std::size_t i) {
    return root_ / fmt::format("mav0/cam{}/data/{}.png", camera, stamps[i]);
  };
  std::filesystem::remove(image(0, 1));
  test::write_text(image(1, 2), "");
  std::filesystem::resize_file(image(0, 3), std::filesystem::file_size(image(0, 3)) / 2);
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), 5u);
  EXPECT_TRUE(samples[1].frame.images[0].empty());
  EXPECT_TRUE(samples[2].frame.images[1].empty());
  EXPECT_TRUE(samples[3].frame.images[0].empty());
  EXPECT_FALSE(samples[3].frame.images[1].empty());
  EXPECT_EQ(test::count_events(samples),
            (Counts{{"picture_missing", 1}, {"picture_unreadable", 2}}));
}

TEST_F(EurocReaderTest, ReadsTheLensesOfFisheyesAndOfKitti) {
  const auto lens_of = [this](const std::string& text) {
    set_sensor("cam0", text);
    return SensorFile(root_ / "mav0/cam0/sensor.yaml").camera();
  };
  // As TUM-VI's.
  const PinholeCamera equidistant = lens_of(
      "T_BS: []\nresolution: [512, 512]\ncamera_model: pinhole\n"
      "intrinsics: [190.97, 190.98, 254.93, 256.9]\ndistortion_model: equidistant\n"
      "distortion_coefficients: [0.0035, 0.0007, -0.002, 0.0002]\n");
  EXPECT_EQ(equidistant.lens, LensModel::kEquidistant);
  EXPECT_EQ(equidistant.coefficients(), (std::vector<double>{0.0035, 0.0007, -0.002, 0.0002}));
  // As Kalibr writes double spheres: xi and alpha first.
  const PinholeCamera spheres = lens_of(
      "resolution: [512, 512]\ncamera_model: ds\n"
      "intrinsics: [-0.18, 0.59, 157.9, 158, 254.9, 256.9]\ndistortion_model: none\n");
  EXPECT_EQ(spheres.lens, LensModel::kDoubleSphere);
  EXPECT_EQ(spheres.coefficients(), (std::vector<double>{-0.18, 0.59}));
  EXPECT_EQ(spheres.fx, 157.9);
  EXPECT_EQ(spheres.cy, 256.9);
  const PinholeCamera five = lens_of(
      "resolution: [1392, 512]\nintrinsics: [984, 981, 690, 233]\n"
      "distortion_model: plumb_bob\n"
      "distortion_coefficients: [-0.37, 0.2, 0.001, 0.002, -0.07]\n");
  EXPECT_EQ(five.coefficients(), (std::vector<double>{-0.37, 0.2, 0.001, 0.002, -0.07}));
  // What is written is read.
  for (const PinholeCamera& camera : {equidistant, spheres, five}) {
    const PinholeCamera back = lens_of(
        fmt::format("resolution: [{}, {}]\n{}", camera.width, camera.height, sensor_lens(camera)));
    EXPECT_EQ(back.lens, camera.lens);
    EXPECT_EQ(back.distortion, camera.distortion);
    EXPECT_EQ(back.fx, camera.fx);
  }
}

TEST_F(EurocReaderTest, FaultyCalibrationsAreErrors) {
  set_sensor("cam1", edited("0, 0, 0, 1]", "0, 0, 1]"));
  expect_error("cam1/sensor.yaml:5: T_BS: expected 16 numbers, found 15");
  set_sensor("cam1", edited("-1, 0, 0, 0", "-1, 0.5, 0, 0"));
  expect_error("T_BS: expected a rotation");
  set_sensor("cam1", edited("[20, 20, 15, 11]", "[20, 20, 15]"));
  expect_error("intrinsics: expected 4 numbers, found 3");
  set_sensor("cam1", edited("[0, 0, 0, 0]\n", "[0, 0, 0]\n"));
  expect_error("distortion_coefficients: expected k1, k2, p1, p2, or these and k3");
  set_sensor("cam1", edited("radial-tangential", "fov"));
  expect_error("distortion_model: expected radial-tangential");
  set_sensor("cam1", edited("camera_model: pinhole", "camera_model: ds"));
  expect_error("intrinsics: expected 6 numbers, found 4");
  set_sensor("cam1", edited("resolution: [32", "resolution: [64"));
  expect_error("camera 'cam1': its calibration is for 64 x 24 pixels, its first image has 32 x 24");
  for (const char* side : {"15", "16385", "32.5", "-32", "7e54"}) {
    set_sensor("cam1", edited("resolution: [32", std::string("resolution: [") + side));
    expect_error("resolution: expected 16 to 16384 pixels a side, found ");
  }
  set_sensor("cam1", edited("[20, 20, 15, 11]", "[0, 20, 15, 11]"));
  expect_error("intrinsics: expected focal lengths above 0");
  set_sensor("cam1", "T_BS: [1, 2");
  expect_error("is not valid YAML");
  std::filesystem::remove(root_ / "mav0/cam1/sensor.yaml");
  expect_error("cam1/sensor.yaml: cannot be read");
}

TEST_F(EurocReaderTest, FaultyFoldersAreErrors) {
  test::write_text(root_ / "mav0/cam1/data.csv", "#timestamp [ns],filename\n");
  expect_error("cam1/data.csv: expected a line for each image");
  test::write_text(root_ / "mav0/cam1/data.csv", "12345\n");
  expect_error("cam1/data.csv:1: expected 2 columns");
  test::write_text(root_ / "mav0/cam1/data.csv", "1.5,1.png\n");
  expect_error("cam1/data.csv:1: expected a whole number of nanoseconds, found '1.5'");
  // 2^62: the difference of two such stamps would be no stamp.
  test::write_text(root_ / "mav0/cam1/data.csv", "4611686018427387904,1.png\n");
  expect_error("cam1/data.csv:1: expected a whole number of nanoseconds, found '46116");
  std::filesystem::remove_all(root_ / "mav0/cam1");
  expect_error("expected a cam1 beside cam0");
  std::filesystem::remove_all(root_ / "mav0/cam0");
  expect_error("expected the folders cam0 and cam1");
}

TEST_F(EurocReaderTest, FaultyReadingsAreErrors) {
  test::write_text(root_ / "mav0/imu0/data.csv", "1,2,3\n");
  expect_error("imu0/data.csv:1: expected 7 columns");
  std::filesystem::remove_all(root_ / "mav0/imu0");
  test::write_text(root_ / "mav0/state_groundtruth_estimate0/data.csv", "#\n1,0,0,0,2,0,0,0\n");
  expect_error("state_groundtruth_estimate0/data.csv:2: expected a unit quaternion");
}

TEST_F(EurocReaderTest, ARigOfOnesOwnTakesTheCalibrationsPlace) {
  RigConfig rig;
  for (const char* name : {"left", "right"}) {
    RigConfig::Camera camera;
    camera.name = name;
    camera.width = test::kWidth;
    camera.height = test::kHeight;
    camera.position.y() = rig.cameras.empty() ? 0 : -0.3;
    rig.cameras.push_back(camera);
  }
  rig.stereo_pairs = {{"cameras", "left", "right"}};
  test::write_text(root_ / "own.yaml", format_yaml(rig));
  const Recording recording = open_recording(root_, {.rig = root_ / "own.yaml", .groundtruth = {}});
  EXPECT_EQ(recording.rig.cameras[1].name, "right");
  EXPECT_NEAR(recording.rig.baseline(recording.rig.stereo_pairs[0]), 0.3, 1e-15);
  rig.cameras.push_back(rig.cameras[0]);
  rig.cameras.back().name = "third";
  test::write_text(root_ / "own.yaml", format_yaml(rig));
  EXPECT_THAT(
      error_of([&] { open_recording(root_, {.rig = root_ / "own.yaml", .groundtruth = {}}); }),
      HasSubstr("has 3 cameras, the recording has 2"));
}

TEST_F(EurocReaderTest, WhatIsNoFileIsAnError) {
  for (const char* name : {"rig.yaml", "slam.yaml", "tags.yaml", "frames.csv"}) {
    test::make_pipe(folder_, std::string("euroc/") + name);
    EXPECT_THAT(error_of([&] {
                  const Recording recording = open_recording(root_);
                  if (!recording.settings.empty()) read_file(recording.settings);
                }),
                HasSubstr(std::string(name) + ": expected a regular file"));
    std::filesystem::remove(root_ / name);
  }
  const std::string sensor = "mav0/cam1/sensor.yaml";
  std::filesystem::remove(root_ / sensor);
  test::link_to_device(folder_, "euroc/" + sensor);
  EXPECT_THAT(error_of([&] { open_recording(root_); }), HasSubstr("a pipe or a device"));
}

TEST_F(EurocReaderTest, ImagesThatAreNoFilesAreFaultsOfTheirFrames) {
  const auto image = [&](int frame) {
    return fmt::format("euroc/mav0/cam0/data/{}.png", test::regular_stamps(5)[frame]);
  };
  for (const int frame : {0, 2, 3}) std::filesystem::remove(folder_ / image(frame));
  test::make_pipe(folder_, image(0));
  test::link_to_device(folder_, image(2));
  folder_.write(image(3), test::png_of_size(40000, 40000));
  const std::vector<Sample> samples = test::play_all(root_);
  EXPECT_EQ(test::count_events(samples)["picture_unreadable"], 3);
  const auto& events = samples[3].events;
  ASSERT_FALSE(events.empty());
  EXPECT_THAT(events[0].detail, HasSubstr("40000 x 40000"));
}

TEST_F(EurocReaderTest, SizesBeyondAllCamerasAreErrors) {
  for (const char* size : {"[1e300, 24]", "[32, 16385]", "[-32, 24]", "[.nan, 24]"}) {
    std::string text = test::sensor_yaml(0);
    const std::size_t at = text.find("[32, 24]");
    ASSERT_NE(at, std::string::npos);
    test::write_text(root_ / "mav0/cam0/sensor.yaml", text.replace(at, 8, size));
    EXPECT_NE(error_of([&] { open_recording(root_); }), "") << size;
  }
}

TEST(PoseAtTest, LiesBetweenItsNeighbours) {
  const auto at = [](Stamp stamp, double x) {
    return StampedPose{stamp, {Eigen::Quaterniond::Identity(), {x, 0, 0}}};
  };
  const Trajectory trajectory{at(1'000'000'000, 0), at(1'200'000'000, 2), at(3'000'000'000, 9)};
  const Stamp gap = kNanosecondsPerSecond / 4;
  EXPECT_NEAR(pose_at(trajectory, 1'050'000'000, gap)->translation.x(), 0.5, 1e-12);
  EXPECT_EQ(pose_at(trajectory, 1'200'000'000, gap)->translation.x(), 2);
  EXPECT_EQ(pose_at(trajectory, 1'200'000'800, gap)->translation.x(), 2);  // within a microsecond
  EXPECT_EQ(pose_at(trajectory, 3'000'000'000, gap)->translation.x(), 9);
  EXPECT_FALSE(pose_at(trajectory, 2'000'000'000, gap));  // a gap of 1.8 s
  EXPECT_FALSE(pose_at(trajectory, 900'000'000, gap));
  EXPECT_FALSE(pose_at(trajectory, 3'100'000'000, gap));
  EXPECT_FALSE(pose_at({}, 0, gap));
}

}  // namespace
}  // namespace vinebench::harness
