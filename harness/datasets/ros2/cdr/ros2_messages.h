// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "harness/datasets/ros/messages/ros_messages.h"
#include "harness/datasets/ros2/cdr/encoded_message.h"

namespace vinebench::harness {

/// Names of ROS 2's types, as in bags.
namespace ros2 {
inline constexpr const char* kImage = "sensor_msgs/msg/Image";
inline constexpr const char* kCompressedImage = "sensor_msgs/msg/CompressedImage";
inline constexpr const char* kCameraInfo = "sensor_msgs/msg/CameraInfo";
inline constexpr const char* kImu = "sensor_msgs/msg/Imu";
inline constexpr const char* kJointState = "sensor_msgs/msg/JointState";
inline constexpr const char* kOdometry = "nav_msgs/msg/Odometry";
inline constexpr const char* kTransforms = "tf2_msgs/msg/TFMessage";
inline constexpr const char* kClock = "rosgraph_msgs/msg/Clock";
inline constexpr const char* kPose = "geometry_msgs/msg/PoseStamped";
inline constexpr const char* kPoseWithCovariance = "geometry_msgs/msg/PoseWithCovarianceStamped";
inline constexpr const char* kTransform = "geometry_msgs/msg/TransformStamped";
}  // namespace ros2

/// Messages in CDR.
std::string encode_clock(std::int64_t time);
std::string encode(const std::vector<RosTransform>& transforms);
std::string encode(const RosImage& image);
std::string encode(const RosCompressedImage& image);
std::string encode(const RosCameraInfo& info);
std::string encode(const RosImu& reading);
std::string encode(const RosJointState& reading);
std::string encode(const RosOdometry& odometry);

/// What is read of a message; the rest is not looked at. Throws Error that names the message's
/// byte, also for a time before 0 or beyond kMostStamp.
RosHeader decode_header(const EncodedMessage& message);
std::vector<RosTransform> decode_transforms(const EncodedMessage& message);
RosCompressedImage decode_compressed_image(const EncodedMessage& message);
RosCameraInfo decode_camera_info(const EncodedMessage& message);
RosImu decode_imu(const EncodedMessage& message);
RosJointState decode_joint_state(const EncodedMessage& message);

/// An image whose rows may be padded.
struct PaddedImage {
  RosHeader header;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string encoding;
  std::uint32_t step = 0;  ///< bytes of a row
  std::string_view bytes;  ///< of the message
};
PaddedImage decode_image(const EncodedMessage& message);

/// Of Odometry, PoseStamped, PoseWithCovarianceStamped and TransformStamped: T_parent_child, or the
/// pose of nothing in particular, whose child is "". Throws Error for another type.
RosTransform decode_pose(const std::string& type, const EncodedMessage& message);

}  // namespace vinebench::harness
