// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/slam.h"
#include "tests/support/recorded_folders.h"
#include "tests/support/special_files.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::HasSubstr;
using Counts = std::map<std::string, int>;

class KittiReaderTest : public testing::Test {
 protected:
  test::TestFolder folder_;
  std::filesystem::path root_ = test::write_kitti(folder_);
};

TEST_F(KittiReaderTest, ReadsAnExcerptWithoutLabelsAndTimes) {
  const Recording recording = open_recording(root_);
  EXPECT_EQ(recording.name, "kitti");
  EXPECT_EQ(recording.rig.rate_hz, 10);
  ASSERT_EQ(recording.frames.size(), 5u);
  EXPECT_EQ(recording.frames[3].stamp, 300'000'000);
  const PinholeCamera& lens = recording.rig.cameras[1].model;
  EXPECT_EQ(lens.width, test::kWidth);
  EXPECT_EQ(lens.height, test::kHeight);
  EXPECT_EQ(lens.fx, 20);
  EXPECT_EQ(lens.cy, 11);
  // P1's fourth number is -fx b: b = 10 / 20 = 0.5 m, to the right, that is along -y of the body.
  const Eigen::Vector3d right = recording.rig.cameras[1].T_body_cam.translation;
  EXPECT_LT((right - Eigen::Vector3d(0, -0.5, 0)).norm(), 1e-15);
  EXPECT_NEAR(recording.rig.baseline(recording.rig.stereo_pairs[0]), 0.5, 1e-15);
  // Its pair needs no rectification: make_slam takes it.
  WorkerPool pool(1);
  EXPECT_NO_THROW(slam::make_slam({}, recording.rig, {}, pool));
}

TEST_F(KittiReaderTest, ThePosesBecomeTheBodys) {
  // Ahead in KITTI is z of the camera; here it is x of the world, and the body is level.
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), 5u);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Truth& truth = samples[i].truth;
    EXPECT_TRUE(truth.known);
    EXPECT_LT((truth.T_world_body.translation - Eigen::Vector3d(double(i), 0, 0)).norm(), 1e-12);
    EXPECT_LT(angle_of(truth.T_world_body.rotation), 1e-7);
    EXPECT_EQ(test::grey_of(samples[i].frame.images[0]), int(i));
    EXPECT_EQ(test::grey_of(samples[i].frame.images[1]), 20 + int(i));
    EXPECT_TRUE(samples[i].events.empty());
  }
}

TEST_F(KittiReaderTest, LabelsSayWhichMatrixIsWhose) {
  std::filesystem::rename(root_ / "image_l", root_ / "image_2");
  std::filesystem::rename(root_ / "image_r", root_ / "image_3");
  test::write_text(root_ / "calib.txt",
                   "P0: 20 0 15 0 0 20 11 0 0 0 1 0\nP1: 20 0 15 -10 0 20 11 0 0 0 1 0\n"
                   "P2: 20 0 15 1 0 20 11 0 0 0 1 0\nP3: 20 0 15 -9 0 20 11 0 0 0 1 0\n"
                   "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  const Recording recording = open_recording(root_);
  // Camera 2 is 1/20 m to the left of camera 0, whose pose the truth contains.
  EXPECT_NEAR(recording.rig.cameras[0].T_body_cam.translation.y(), 0.05, 1e-15);
  EXPECT_NEAR(recording.rig.baseline(recording.rig.stereo_pairs[0]), 0.5, 1e-15);
  EXPECT_NEAR(recording.truth[2].pose.translation.norm(), 2, 1e-12);  // of the body: camera 0
}

TEST_F(KittiReaderTest, TimesAreThoseOfTheFile) {
  test::write_text(root_ / "times.txt", "0\n1.0e-01\n0.25\n0.3\n0.4\n");
  const Recording recording = open_recording(root_);
  EXPECT_EQ(recording.frames[1].stamp, 100'000'000);
  EXPECT_EQ(recording.frames[2].stamp, 250'000'000);
  test::write_text(root_ / "times.txt", "0\n0.1\n0.2\n");
  EXPECT_THAT(error_of([&] { open_recording(root_); }), HasSubstr("times.txt: expected 5 lines"));
  test::write_text(root_ / "times.txt", "0\n0.1\n0.2\n0.15\n0.4\n");
  EXPECT_THAT(error_of([&] { open_recording(root_); }), HasSubstr("times.txt:4: expected a later"));
  test::write_text(root_ / "times.txt", "0\n0.1\n0.2\n1e300\n0.4\n");
  EXPECT_THAT(error_of([&] { open_recording(root_); }),
              HasSubstr("times.txt:4: expected a time in seconds, found '1e300'"));
}

TEST_F(KittiReaderTest, AMissingImageIsABlindCamera) {
  std::filesystem::remove(root_ / "image_r/000004.png");  // fewer on the right
  std::filesystem::remove(root_ / "image_l/000001.png");
  std::filesystem::remove(root_ / "image_r/000001.png");  // frame 1 is missing completely
  test::write_text(root_ / "image_l/000002.png", "no image");
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), 5u);
  EXPECT_TRUE(samples[4].frame.images[1].empty());
  EXPECT_FALSE(samples[4].frame.images[0].empty());
  EXPECT_TRUE(samples[1].frame.images[0].empty());
  EXPECT_TRUE(samples[2].frame.images[0].empty());
  EXPECT_EQ(test::count_events(samples),
            (Counts{{"picture_missing", 3}, {"picture_unreadable", 1}}));
  EXPECT_EQ(samples[2].events.at(0).sensor, "left");
  EXPECT_THAT(samples[2].events.at(0).detail, HasSubstr("000002.png"));
}

TEST_F(KittiReaderTest, AnImageOfAnotherSizeIsABlindCamera) {
  test::write_image(root_ / "image_r/000003.png", cv::Mat(8, 8, CV_8UC1, cv::Scalar(1)));
  const std::vector<Sample> samples = test::play_all(root_);
  EXPECT_TRUE(samples[3].frame.images[1].empty());
  EXPECT_EQ(test::count_events(samples), (Counts{{"picture_of_wrong_size", 1}}));
}

TEST_F(KittiReaderTest, PosesOfAnotherLengthAreTold) {
  test::write_text(root_ / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n");
  const std::vector<Sample> samples = test::play_all(root_);
  ASSERT_EQ(samples.size(), 5u);
  EXPECT_TRUE(samples[1].truth.known);
  EXPECT_FALSE(samples[2].truth.known);
  EXPECT_EQ(test::count_events(samples),
            (Counts{{"groundtruth_length", 1}, {"groundtruth_missing", 3}}));
}

TEST_F(KittiReaderTest, FaultyCalibrationsAreErrors) {
  test::write_text(root_ / "calib.txt", "20 0 15 0 0 20 11 0 0 0 1 0\n20 0 15 -10 0 20 11 0 0\n");
  EXPECT_THAT(error_of([&] { open_recording(root_); }),
              HasSubstr("calib.txt:2: expected 12 numbers (3 x 4, row by row), found 9"));
  test::write_text(root_ / "calib.txt", "P0: 20 0 15 0 0 20 11 0 0 0 1 0\n");
  EXPECT_THAT(error_of([&] { open_recording(root_); }), HasSubstr("expected a matrix P1"));
  test::write_text(root_ / "calib.txt", "P0: 20 0 15 0 0 20 eleven 0 0 0 1 0\n");
  EXPECT_THAT(error_of([&] { open_recording(root_); }),
              HasSubstr("calib.txt:1: expected a number, found 'eleven'"));
  std::filesystem::remove(root_ / "calib.txt");
  EXPECT_THAT(error_of([&] { open_recording(root_); }), HasSubstr("calib.txt: cannot be read"));
}

// A pipe would be waited for, a device never end.
TEST_F(KittiReaderTest, WhatIsNoFileIsAnError) {
  for (const char* name : {"calib.txt", "times.txt", "poses.txt", "rig.yaml"}) {
    for (const auto& make : {test::make_pipe, test::link_to_device, test::make_loop}) {
      const bool was_there = std::filesystem::exists(root_ / name);
      if (was_there) std::filesystem::rename(root_ / name, folder_ / "kept");
      make(folder_, std::string("kitti/") + name);
      EXPECT_THAT(error_of([&] { open_recording(root_); }), HasSubstr(name));
      std::filesystem::remove(root_ / name);
      if (was_there) std::filesystem::rename(folder_ / "kept", root_ / name);
    }
  }
  EXPECT_NO_THROW(open_recording(root_));
}

// A form feed is a blank, but does not end in a field.
TEST_F(KittiReaderTest, ALineOfOtherBlanksIsEmpty) {
  const std::string text = read_file(root_ / "poses.txt");
  test::write_text(root_ / "poses.txt", "\f\n" + text + "\v\n");
  EXPECT_EQ(test::count_events(test::play_all(root_)), Counts());
}

TEST_F(KittiReaderTest, FaultyPosesAreErrors) {
  test::write_text(root_ / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1\n");
  EXPECT_THAT(error_of([&] { open_recording(root_); }),
              HasSubstr("poses.txt:2: expected 12 columns"));
  test::write_text(root_ / "poses.txt", "1 0 0 0 0 2 0 0 0 0 1 0\n");
  EXPECT_THAT(error_of([&] { open_recording(root_); }),
              HasSubstr("poses.txt:1: expected a rotation matrix"));
}

TEST_F(KittiReaderTest, FoldersWithoutImagesAreErrors) {
  std::filesystem::remove_all(root_ / "image_r");
  std::filesystem::create_directories(root_ / "image_r");
  EXPECT_THAT(error_of([&] { open_recording(root_); }), HasSubstr("image_r: expected images"));
  std::filesystem::remove_all(root_ / "image_r");
  EXPECT_THAT(error_of([&] { open_recording(root_); }), HasSubstr("image_r: cannot be read"));
  std::filesystem::create_directories(folder_ / "empty");
  EXPECT_THAT(error_of([&] { open_recording(folder_ / "empty"); }),
              HasSubstr("is not a recording"));
  EXPECT_THAT(error_of([&] { open_recording(folder_ / "none"); }), HasSubstr("expected a folder"));
}

TEST_F(KittiReaderTest, AGroundTruthOfOnesOwn) {
  const auto truth_at_2 = [&](const std::string& text) {
    test::write_text(root_ / "own.txt", text);
    return test::play_all(root_, {.rig = {}, .groundtruth = root_ / "own.txt"})
        .at(2)
        .truth.T_world_body.translation.x();
  };
  EXPECT_EQ(truth_at_2("0 0 0 0 0 0 0 1\n0.2 7 0 0 0 0 0 1\n0.4 8 0 0 0 0 0 1\n"), 7);
  EXPECT_EQ(truth_at_2("#t,x,y,z,w,x,y,z,v\n0,0,0,0,1,0,0,0,0\n200000000,6,0,0,1,0,0,0,0\n"), 6);
  EXPECT_NEAR(truth_at_2("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n"
                         "1 0 0 0 0 1 0 0 0 0 1 5\n"),
              5, 1e-12);
  EXPECT_THAT(error_of([&] { truth_at_2("1 2 3\n"); }), HasSubstr("own.txt:1: expected 8 columns"));
  EXPECT_THAT(error_of([&] { truth_at_2("# nothing\n"); }),
              HasSubstr("expected poses, found none"));
}

}  // namespace
}  // namespace vinebench::harness
