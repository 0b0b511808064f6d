// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <functional>

#include "harness/datasets/ros2/cdr/cdr_writer.h"
#include "harness/datasets/ros2/cdr/ros2_messages.h"
#include "tests/support/test_folder.h"

namespace vinebench::harness {
namespace {

using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;
using namespace std::string_literals;

const RosHeader kHeader{12'345'678'901, "left_optical_frame"};

TEST(Ros2MessagesTest, ATimeIsSecondsAndNanoseconds) {
  // 0.5e9 ns = 0x1dcd6500
  EXPECT_EQ(encode_clock(2'500'000'000), "\0\1\0\0\2\0\0\0\0\x65\xcd\x1d"s);
}

TEST(Ros2MessagesTest, AnImageComesBack) {
  const std::string message = encode(RosImage{kHeader, 3, 2, "mono8", "abcdef"});
  const PaddedImage image = decode_image(message);
  EXPECT_EQ(image.header.time, kHeader.time);
  EXPECT_EQ(image.header.frame, kHeader.frame);
  EXPECT_EQ(image.width, 3u);
  EXPECT_EQ(image.height, 2u);
  EXPECT_EQ(image.step, 3u);
  EXPECT_EQ(image.encoding, "mono8");
  EXPECT_EQ(image.bytes, "abcdef");
  const RosCompressedImage jpeg =
      decode_compressed_image(encode(RosCompressedImage{kHeader, "jpeg", "\xff\xd8"}));
  EXPECT_EQ(jpeg.format, "jpeg");
  EXPECT_EQ(jpeg.bytes, "\xff\xd8");
}

TEST(Ros2MessagesTest, ACalibrationComesBack) {
  RosCameraInfo info;
  info.header = kHeader;
  info.width = 752;
  info.height = 480;
  info.D = {-0.1, 0.02, 1e-3, -2e-3, 0};
  info.K = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  info.R = {9, 8, 7, 6, 5, 4, 3, 2, 1};
  info.P = {1, 2, 3, -4, 5, 6, 7, 8, 9, 10, 11, 12};
  const RosCameraInfo back = decode_camera_info(encode(info));
  EXPECT_EQ(back.width, 752);
  EXPECT_EQ(back.height, 480);
  EXPECT_EQ(back.model, "plumb_bob");
  EXPECT_EQ(back.D, info.D);
  EXPECT_EQ(back.K, info.K);
  EXPECT_EQ(back.R, info.R);
  EXPECT_EQ(back.P, info.P);
}

TEST(Ros2MessagesTest, ReadingsComeBack) {
  const RosImu imu = decode_imu(encode(RosImu{kHeader, {1, 2, 3}, {4, 5, 9.81}, 0.25, 0.5}));
  EXPECT_EQ(imu.header.time, kHeader.time);
  EXPECT_THAT(imu.angular_velocity, ElementsAre(1, 2, 3));
  EXPECT_THAT(imu.linear_acceleration, ElementsAre(4, 5, 9.81));
  EXPECT_EQ(imu.angular_velocity_variance, 0.25);
  EXPECT_EQ(imu.linear_acceleration_variance, 0.5);
  const RosJointState wheels =
      decode_joint_state(encode(RosJointState{kHeader, {"a", "bc"}, {0.5, 0.25}, {-1, 1}}));
  EXPECT_THAT(wheels.names, ElementsAre("a", "bc"));
  EXPECT_THAT(wheels.positions, ElementsAre(0.5, 0.25));
  EXPECT_THAT(wheels.velocities, ElementsAre(-1, 1));
}

TEST(Ros2MessagesTest, PosesComeBack) {
  const RosPose pose{{1, 2, 3}, {0.5, 0.5, -0.5, 0.5}};
  const auto transforms = decode_transforms(
      encode(std::vector<RosTransform>{{kHeader, "right", pose}, {kHeader, "left", pose}}));
  ASSERT_EQ(transforms.size(), 2u);
  EXPECT_EQ(transforms[1].child, "left");
  EXPECT_EQ(transforms[1].pose.position, pose.position);
  const RosTransform truth =
      decode_pose(ros2::kOdometry, encode(RosOdometry{kHeader, "body", pose, {1, 0, 0}, {}}));
  EXPECT_EQ(truth.child, "body");
  EXPECT_EQ(truth.pose.rotation, pose.rotation);
  // PoseStamped is a header and a pose.
  CdrWriter stamped;
  stamped.put(std::int32_t{3});
  stamped.put(std::uint32_t{1});
  stamped.put_text("map");
  stamped.put_array(pose.position);
  stamped.put_array(pose.rotation);
  const RosTransform plain = decode_pose(ros2::kPose, stamped.take());
  EXPECT_EQ(plain.header.time, 3'000'000'001);
  EXPECT_EQ(plain.child, "");
  EXPECT_EQ(plain.pose.rotation, pose.rotation);
  EXPECT_THAT(error_of([] { decode_pose("std_msgs/msg/String", "\0\1\0\0"s); }),
              HasSubstr("found std_msgs/msg/String"));
}

/// Every message, cut off after each of its bytes that are read, is an error.
TEST(Ros2MessagesTest, AMessageThatEndsTooEarlyIsAnError) {
  const auto expect_errors = [](const std::string& message, std::size_t unread, const auto& read) {
    read(message);
    for (std::size_t size = 0; size < message.size() - unread; ++size) {
      EXPECT_NE(error_of([&] { read(message.substr(0, size)); }), "") << size;
    }
  };
  expect_errors(encode(RosImage{kHeader, 3, 2, "mono8", "abcdef"}), 0,
                [](const std::string& m) { decode_image(m); });
  expect_errors(encode(RosCompressedImage{kHeader, "png", "abc"}), 0,
                [](const std::string& m) { decode_compressed_image(m); });
  RosCameraInfo info;
  info.D = {0, 0, 0, 0, 0};
  expect_errors(encode(info), 25,  // binning and region: six numbers of 4 bytes, one of 1
                [](const std::string& m) { decode_camera_info(m); });
  expect_errors(encode(RosImu{kHeader, {}, {}, 0, 0}), 0,
                [](const std::string& m) { decode_imu(m); });
  expect_errors(encode(RosJointState{kHeader, {"a"}, {1}, {2}}), 8,  // effort, with its alignment
                [](const std::string& m) { decode_joint_state(m); });
  expect_errors(encode(std::vector<RosTransform>{{kHeader, "left", {}}}), 0,
                [](const std::string& m) { decode_transforms(m); });
}

TEST(Ros2MessagesTest, TimesThatAreNoneAreErrors) {
  const auto read = [](std::int32_t seconds, std::uint32_t nanoseconds) {
    CdrWriter out;
    out.put(seconds);
    out.put(nanoseconds);
    out.put_text("");
    return error_of([&] { decode_header(out.take()); });
  };
  EXPECT_EQ(read(0, 999'999'999), "");
  EXPECT_THAT(read(0, 1'000'000'000), HasSubstr("found 0 s 1000000000 ns"));
  EXPECT_THAT(read(-1, 0), HasSubstr("found -1 s"));
}

}  // namespace
}  // namespace vinebench::harness
