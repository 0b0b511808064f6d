// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "core/time.h"
#include "core/util/error.h"
#include "harness/datasets/ros2/cdr/cdr_reader.h"
#include "harness/datasets/ros2/cdr/ros2_messages.h"

namespace vinebench::harness {
namespace {

constexpr std::size_t kSmallestText = 4;        // bytes of an element of a sequence: its length
constexpr std::size_t kSmallestTransform = 72;  // bytes of seven numbers, a time, two lengths

std::int64_t get_time(CdrReader& in) {
  const auto seconds = in.get<std::int32_t>();
  const auto nanoseconds = in.get<std::uint32_t>();
  if (seconds < 0 || nanoseconds >= kNanosecondsPerSecond) {
    fail("expected a time from 0 on with less than 1000000000 ns, found {} s {} ns", seconds,
         nanoseconds);
  }
  return seconds * kNanosecondsPerSecond + nanoseconds;
}

RosHeader get_header(CdrReader& in) {
  RosHeader header;
  if (in.coding() == MessageCoding::kRos1) in.get<std::uint32_t>();  // seq, a running number
  header.time = get_time(in);
  header.frame = in.get_text();
  return header;
}

RosPose get_pose(CdrReader& in) {
  RosPose pose;
  in.get_array(pose.position);
  in.get_array(pose.rotation);
  return pose;
}

/// The first number of a covariance.
double get_variance(CdrReader& in) {
  std::array<double, 9> covariance{};
  in.get_array(covariance);
  return covariance[0];
}

RosTransform get_transform(CdrReader& in) {
  RosTransform transform;
  transform.header = get_header(in);
  transform.child = in.get_text();
  transform.pose = get_pose(in);
  return transform;
}

int get_side(CdrReader& in) {
  const auto pixels = in.get<std::uint32_t>();
  if (pixels > static_cast<std::uint32_t>(std::numeric_limits<int>::max())) {
    fail("expected a number of pixels, found {}", pixels);
  }
  return static_cast<int>(pixels);
}

}  // namespace

RosHeader decode_header(const EncodedMessage& message) {
  CdrReader in(message);
  return get_header(in);
}

std::vector<RosTransform> decode_transforms(const EncodedMessage& message) {
  CdrReader in(message);
  std::vector<RosTransform> transforms(in.get_length(kSmallestTransform));
  for (RosTransform& transform : transforms) transform = get_transform(in);
  return transforms;
}

PaddedImage decode_image(const EncodedMessage& message) {
  CdrReader in(message);
  PaddedImage image;
  image.header = get_header(in);
  image.height = in.get<std::uint32_t>();
  image.width = in.get<std::uint32_t>();
  image.encoding = in.get_text();
  in.get<std::uint8_t>();  // is_bigendian: there is nothing to swap in bytes
  image.step = in.get<std::uint32_t>();
  image.bytes = in.get_bytes();
  return image;
}

RosCompressedImage decode_compressed_image(const EncodedMessage& message) {
  CdrReader in(message);
  RosCompressedImage image;
  image.header = get_header(in);
  image.format = in.get_text();
  image.bytes = std::string(in.get_bytes());
  return image;
}

RosCameraInfo decode_camera_info(const EncodedMessage& message) {
  CdrReader in(message);
  RosCameraInfo info;
  info.header = get_header(in);
  info.height = get_side(in);
  info.width = get_side(in);
  info.model = in.get_text();
  info.D = in.get_numbers();
  in.get_array(info.K);
  in.get_array(info.R);
  in.get_array(info.P);
  return info;
}

RosImu decode_imu(const EncodedMessage& message) {
  CdrReader in(message);
  RosImu reading;
  reading.header = get_header(in);
  RosQuaternion orientation;
  in.get_array(orientation);
  get_variance(in);
  in.get_array(reading.angular_velocity);
  reading.angular_velocity_variance = get_variance(in);
  in.get_array(reading.linear_acceleration);
  reading.linear_acceleration_variance = get_variance(in);
  return reading;
}

RosJointState decode_joint_state(const EncodedMessage& message) {
  CdrReader in(message);
  RosJointState reading;
  reading.header = get_header(in);
  reading.names.resize(in.get_length(kSmallestText));
  for (std::string& name : reading.names) name = in.get_text();
  reading.positions = in.get_numbers();
  reading.velocities = in.get_numbers();
  return reading;
}

RosTransform decode_pose(const std::string& type, const EncodedMessage& message) {
  CdrReader in(message);
  if (type == ros2::kTransform || type == ros2::kOdometry) return get_transform(in);
  if (type != ros2::kPose && type != ros2::kPoseWithCovariance) {
    fail("expected {}, {}, {} or {}, found {}", ros2::kOdometry, ros2::kPose,
         ros2::kPoseWithCovariance, ros2::kTransform, type);
  }
  RosTransform pose;
  pose.header = get_header(in);
  pose.pose = get_pose(in);
  return pose;
}

}  // namespace vinebench::harness
