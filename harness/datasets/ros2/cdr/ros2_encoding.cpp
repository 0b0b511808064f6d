// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/cdr/cdr_writer.h"
#include "harness/datasets/ros2/cdr/ros2_messages.h"

namespace vinebench::harness {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;  // ns

void put_time(CdrWriter& out, std::int64_t nanoseconds) {
  out.put(static_cast<std::int32_t>(nanoseconds / kSecond));
  out.put(static_cast<std::uint32_t>(nanoseconds % kSecond));
}

void put_header(CdrWriter& out, const RosHeader& header) {
  put_time(out, header.time);
  out.put_text(header.frame);
}

void put_pose(CdrWriter& out, const RosPose& pose) {
  out.put_array(pose.position);
  out.put_array(pose.rotation);
}

/// The covariance of three independent numbers.
void put_diagonal(CdrWriter& out, double variance) {
  out.put_array(std::array<double, 9>{variance, 0, 0, 0, variance, 0, 0, 0, variance});
}

}  // namespace

std::string encode_clock(std::int64_t time) {
  CdrWriter out;
  put_time(out, time);
  return out.take();
}

std::string encode(const std::vector<RosTransform>& transforms) {
  CdrWriter out;
  out.put(static_cast<std::uint32_t>(transforms.size()));
  for (const RosTransform& transform : transforms) {
    put_header(out, transform.header);
    out.put_text(transform.child);
    put_pose(out, transform.pose);
  }
  return out.take();
}

std::string encode(const RosImage& image) {
  CdrWriter out;
  put_header(out, image.header);
  const auto height = static_cast<std::uint32_t>(image.height);
  out.put(height);
  out.put(static_cast<std::uint32_t>(image.width));
  out.put_text(image.encoding);
  out.put(std::uint8_t{0});  // is_bigendian
  out.put(height > 0 ? static_cast<std::uint32_t>(image.bytes.size()) / height : 0);
  out.put_bytes(image.bytes);
  return out.take();
}

std::string encode(const RosCompressedImage& image) {
  CdrWriter out;
  put_header(out, image.header);
  out.put_text(image.format);
  out.put_bytes(image.bytes);
  return out.take();
}

std::string encode(const RosCameraInfo& info) {
  CdrWriter out;
  put_header(out, info.header);
  out.put(static_cast<std::uint32_t>(info.height));
  out.put(static_cast<std::uint32_t>(info.width));
  out.put_text(info.model);
  out.put_numbers(info.D);
  out.put_array(info.K);
  out.put_array(info.R);
  out.put_array(info.P);
  // binning_x, binning_y; roi: x_offset, y_offset, height, width: the whole image
  for (int i = 0; i < 6; ++i) out.put(std::uint32_t{0});
  out.put(std::uint8_t{0});  // roi.do_rectify
  return out.take();
}

std::string encode(const RosImu& reading) {
  CdrWriter out;
  put_header(out, reading.header);
  out.put_array(RosQuaternion{0, 0, 0, 1});
  out.put_array(std::array<double, 9>{-1});  // ROS: there is no orientation
  out.put_array(reading.angular_velocity);
  put_diagonal(out, reading.angular_velocity_variance);
  out.put_array(reading.linear_acceleration);
  put_diagonal(out, reading.linear_acceleration_variance);
  return out.take();
}

std::string encode(const RosJointState& reading) {
  CdrWriter out;
  put_header(out, reading.header);
  out.put(static_cast<std::uint32_t>(reading.names.size()));
  for (const std::string& name : reading.names) out.put_text(name);
  out.put_numbers(reading.positions);
  out.put_numbers(reading.velocities);
  out.put_numbers({});  // effort
  return out.take();
}

std::string encode(const RosOdometry& odometry) {
  CdrWriter out;
  put_header(out, odometry.header);
  out.put_text(odometry.child);
  put_pose(out, odometry.pose);
  out.put_array(std::array<double, 36>{});  // covariance: not known
  out.put_array(odometry.velocity);
  out.put_array(odometry.angular_velocity);
  out.put_array(std::array<double, 36>{});
  return out.take();
}

}  // namespace vinebench::harness
