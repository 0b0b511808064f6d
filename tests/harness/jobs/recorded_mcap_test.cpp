// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// What is in a bag is read by other libraries in tests/tools/ros2_test.sh.

#include <gmock/gmock.h>

#include <opencv2/core.hpp>

#include "harness/datasets/dataset_check.h"
#include "harness/datasets/open_recording.h"
#include "harness/datasets/reading/dataset_reader.h"
#include "tests/support/small_scenario.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::HasSubstr;

class RecordedMcapTest : public test::SmallScenario {
 protected:
  fs::path bag() const { return request_.out / "mcap/run.mcap"; }

  static std::vector<Sample> play(const fs::path& recording) {
    WorkerPool pool(2);
    DatasetReader reader(open_recording(recording), pool);
    std::vector<Sample> samples;
    while (auto sample = reader.next()) samples.push_back(std::move(*sample));
    return samples;
  }
};

/// A replay of the bag gets what a replay of the EuRoC folder gets, which is bit by bit the run's.
TEST_F(RecordedMcapTest, ItsReplayIsThatOfEuroc) {
  record({"mcap", "euroc"});
  EXPECT_THAT(check_dataset(request_.out).faults, testing::IsEmpty());
  const Recording euroc = open_recording(request_.out / "euroc");
  const Recording mcap = open_recording(request_.out / "mcap");
  EXPECT_EQ(mcap.tags.size(), euroc.tags.size());
  EXPECT_EQ(read_file(mcap.settings), read_file(euroc.settings));
  const std::vector<Sample> expected = play(request_.out / "euroc");
  const std::vector<Sample> found = play(request_.out / "mcap");
  ASSERT_EQ(found.size(), 6u);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Frame& a = found[i].frame;
    const Frame& b = expected[i].frame;
    EXPECT_EQ(a.stamp, b.stamp);
    ASSERT_EQ(a.imu.size(), b.imu.size());
    for (std::size_t k = 0; k < a.imu.size(); ++k) {
      EXPECT_EQ(a.imu[k].stamp, b.imu[k].stamp);
      EXPECT_EQ(a.imu[k].specific_force, b.imu[k].specific_force);
      EXPECT_EQ(a.imu[k].angular_velocity, b.imu[k].angular_velocity);
    }
    ASSERT_EQ(a.wheels.size(), b.wheels.size());
    for (std::size_t k = 0; k < a.wheels.size(); ++k)
      EXPECT_EQ(a.wheels[k].angle, b.wheels[k].angle);
    for (std::size_t camera = 0; camera < 3; ++camera) {
      EXPECT_EQ(cv::norm(a.images[camera], b.images[camera], cv::NORM_INF), 0) << camera;
    }
    EXPECT_EQ(found[i].truth.T_world_body.translation, expected[i].truth.T_world_body.translation);
    EXPECT_TRUE(found[i].events.empty());
  }
}

/// From CameraInfo and /tf_static alone the rig is the same, but for what they do not have.
TEST_F(RecordedMcapTest, TheRigIsInTheBagToo) {
  record({"mcap"});
  fs::create_directories(folder_ / "bare");
  fs::copy_file(bag(), folder_ / "bare/run.mcap");
  const Rig bare = open_recording(folder_ / "bare").rig;
  const Rig rig = open_recording(request_.out).rig;
  ASSERT_EQ(bare.cameras.size(), rig.cameras.size());
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    EXPECT_EQ(bare.cameras[i].name, rig.cameras[i].name);
    EXPECT_EQ(bare.cameras[i].model.fx, rig.cameras[i].model.fx);
    EXPECT_LT(
        (bare.cameras[i].T_body_cam.translation - rig.cameras[i].T_body_cam.translation).norm(),
        1e-12);  // m: rounding of P[3]
    EXPECT_LT(
        bare.cameras[i].T_body_cam.rotation.angularDistance(rig.cameras[i].T_body_cam.rotation),
        1e-12);
  }
  EXPECT_EQ(bare.tag_cameras, rig.tag_cameras);
  EXPECT_EQ(bare.stereo_pairs.size(), rig.stereo_pairs.size());
}

TEST_F(RecordedMcapTest, CompressedImagesInColourAreReplayed) {
  request_.options.images = ImageKind::kPng;
  request_.options.colour = true;
  record({"mcap", "euroc"});
  EXPECT_THAT(read_file(request_.out / "mcap/metadata.yaml"),
              HasSubstr("/left/image_rect/compressed"));
  const std::vector<Sample> expected = play(request_.out / "euroc");
  const std::vector<Sample> found = play(request_.out / "mcap");
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(cv::norm(found[i].frame.images[0], expected[i].frame.images[0], cv::NORM_INF), 0);
  }
}

TEST_F(RecordedMcapTest, AnInterruptedBagIsClosedAndReplayed) {
  EXPECT_TRUE(record({"mcap"}, 3).interrupted);
  EXPECT_THAT(check_dataset(request_.out).faults, testing::IsEmpty());
  EXPECT_TRUE(fs::exists(request_.out / "mcap/metadata.yaml"));
  EXPECT_EQ(open_recording(request_.out).frames.size(), 3u);
}

TEST_F(RecordedMcapTest, WhatABagCannotHaveIsAnError) {
  request_.options.images = ImageKind::kWebp;
  EXPECT_THAT(error_of([&] { record({"mcap"}); }), HasSubstr("--image webp: expected png or jpg"));
  EXPECT_TRUE(fs::is_empty(request_.out));
}

}  // namespace
}  // namespace vinebench::harness
