// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// What is in a bag is read by ROS's own library in tests/tools/ros_test.sh.

#include <gmock/gmock.h>

#include "harness/datasets/dataset_check.h"
#include "harness/datasets/open_recording.h"
#include "harness/datasets/reading/dataset_reader.h"
#include "harness/datasets/reading/recorded_images.h"
#include "harness/datasets/ros/rosbag/ros_bag.h"
#include "tests/support/size_limit.h"
#include "tests/support/small_scenario.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::HasSubstr;

class RecordedBagsTest : public test::SmallScenario {
 protected:
  fs::path bag() const { return request_.out / "ros/run.bag"; }
};

TEST_F(RecordedBagsTest, WithoutRosItIsOneError) {
  if (has_rosbag()) GTEST_SKIP() << "built with rosbag";
  const std::string error = error_of([&] { record({"rgb", "ros"}); });
  EXPECT_THAT(error, HasSubstr("built without ROS's libraries"));
  EXPECT_THAT(error, HasSubstr("librosbag-storage-dev"));
  EXPECT_TRUE(fs::is_empty(request_.out));
  EXPECT_THAT(all_formats(), testing::Not(testing::Contains("ros")));
}

TEST_F(RecordedBagsTest, WhatABagCannotHaveIsAnError) {
  if (!has_rosbag()) GTEST_SKIP() << "built without rosbag";
  request_.options.images = ImageKind::kWebp;
  EXPECT_THAT(error_of([&] { record({"ros"}); }), HasSubstr("--image webp: expected png or jpg"));
  EXPECT_TRUE(fs::is_empty(request_.out));
  request_.options.images.reset();
  std::string rig = read_file(folder_ / "rig.yaml");
  for (std::size_t at; (at = rig.find("side")) != std::string::npos;) rig.replace(at, 4, "2nd");
  folder_.write("rig.yaml", rig);
  EXPECT_THAT(error_of([&] { record({"ros"}); }), HasSubstr("camera '2nd': expected a name"));
}

TEST_F(RecordedBagsTest, AnInterruptedBagIsClosed) {
  if (!has_rosbag()) GTEST_SKIP() << "built without rosbag";
  EXPECT_TRUE(record({"ros"}, 3).interrupted);
  EXPECT_TRUE(fs::exists(bag()));
  EXPECT_FALSE(fs::exists(bag().string() + ".active"));
  EXPECT_THAT(check_dataset(request_.out).faults, testing::IsEmpty());
  const auto of_three = fs::file_size(bag());
  request_.out = folder_ / "whole";
  record({"ros"});
  EXPECT_GT(fs::file_size(bag()), of_three);
}

TEST_F(RecordedBagsTest, ImagesAndColourAreThoseAskedFor) {
  if (!has_rosbag()) GTEST_SKIP() << "built without rosbag";
  record({"ros"});
  const std::string raw = read_file(bag());
  EXPECT_THAT(raw, HasSubstr("mono8"));
  request_.out = folder_ / "png";
  request_.options.images = ImageKind::kPng;
  record({"ros", "euroc"});
  const std::string compressed = read_file(bag());
  EXPECT_THAT(compressed, testing::Not(HasSubstr("mono8")));
  // The same bytes as the file, from one encoding.
  const std::string png = read_file(request_.out / "euroc/mav0/cam2/data/0000000000000000000.png");
  EXPECT_NE(compressed.find(png), std::string::npos);
  EXPECT_FALSE(fs::exists(request_.out / "ros/left"));
}

TEST_F(RecordedBagsTest, ABagIsReplayedAsTheRunItIsOf) {
  if (!has_rosbag()) GTEST_SKIP() << "built without rosbag";
  record({"ros", "euroc"});
  const Recording of_bag = open_recording(bag());
  const Recording of_files = open_recording(request_.out / "euroc");
  ASSERT_EQ(of_bag.frames.size(), of_files.frames.size());
  for (std::size_t i = 0; i < of_bag.frames.size(); ++i) {
    EXPECT_EQ(of_bag.frames[i].stamp, of_files.frames[i].stamp);
    const cv::Mat image = read_grey(of_bag, of_bag.frames[i].images[1]);
    EXPECT_EQ(cv::norm(image, read_grey(of_files.frames[i].images[1]), cv::NORM_INF), 0);
  }
  ASSERT_EQ(of_bag.imu.size(), of_files.imu.size());
  EXPECT_EQ(of_bag.imu.back().stamp, of_files.imu.back().stamp);
  EXPECT_EQ(of_bag.imu.back().specific_force, of_files.imu.back().specific_force);
  EXPECT_EQ(of_bag.wheels.size(), of_files.wheels.size());
  const auto end = pose_at(of_files.truth, of_bag.truth.back().stamp, kNanosecondsPerSecond);
  ASSERT_TRUE(end);
  // Positions of the files have fewer digits than a bag's.
  EXPECT_LT((of_bag.truth.back().pose.translation - end->translation).norm(), 1e-6);
}

TEST_F(RecordedBagsTest, LinksInItsPlaceAreNotFollowed) {
  if (!has_rosbag()) GTEST_SKIP() << "built without rosbag";
  const fs::path target = folder_.write("target", "theirs");
  const fs::path file = folder_ / "linked.bag";
  fs::create_symlink(target, file);
  fs::create_symlink(target, file.string() + ".active");
  RosBag bag(file);
  bag.write_clock("/clock", 1);
  bag.close();
  EXPECT_EQ(read_file(target), "theirs");
  EXPECT_FALSE(fs::is_symlink(file));
  EXPECT_GT(fs::file_size(file), 0u);
}

TEST_F(RecordedBagsTest, ABagThatOutgrowsTheDiskIsClosedAllTheSame) {
  if (!has_rosbag()) GTEST_SKIP() << "built without rosbag";
  const fs::path file = folder_ / "full.bag";
  std::int64_t written = 0;
  std::string error;
  {
    const test::SizeLimit limit(300'000);
    RosBag full(file);
    error = error_of([&] {
      for (std::int64_t i = 1; i < 1000; ++i) {
        full.write("/image", RosImage{{i, "camera"}, 100, 100, "mono8", std::string(10'000, 'x')});
        full.end_chunk();
        ++written;
      }
    });
  }
  EXPECT_EQ(error, file.string() + ": cannot be written: File too large");
  EXPECT_GT(written, 10);
  EXPECT_LE(fs::file_size(file), 300'000u);
  EXPECT_FALSE(fs::exists(file.string() + ".active"));
  // The first record of a closed bag has the position of its index.
  const std::string bytes = read_file(file);
  const std::size_t index = bytes.find("index_pos=");
  ASSERT_NE(index, std::string::npos);
  EXPECT_NE(bytes.substr(index + 10, 8), std::string(8, '\0'));
}

TEST_F(RecordedBagsTest, ABagThatCannotBeMadeIsAnError) {
  if (!has_rosbag()) GTEST_SKIP() << "built without rosbag";
  EXPECT_THAT(error_of([&] { RosBag(folder_ / "none/run.bag"); }),
              HasSubstr("cannot be written: No such file or directory"));
}

}  // namespace
}  // namespace vinebench::harness
