// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Also compiled as C++17, as required by ROS's headers: no C++20 here.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace vinebench::harness {

inline constexpr const char* kRosBody = "base_link";  ///< the body's frame (REP 105)

// Bags of ours are by this node, and ahead of their recordings' stamps, because a time of 0 means
// "not set" in ROS and faults may make stamps negative.
inline constexpr const char* kRosCaller = "/vinebench";
inline constexpr std::int64_t kRosStart = 1'000'000'000;  ///< ns

using RosVector = std::array<double, 3>;
using RosQuaternion = std::array<double, 4>;  ///< x, y, z, w

struct RosHeader {
  std::int64_t time = 0;  ///< ns, above 0 in what is written
  std::string frame;
};

struct RosPose {
  RosVector position{};
  RosQuaternion rotation{0, 0, 0, 1};
};

/// T_parent_child; the parent is the header's frame.
struct RosTransform {
  RosHeader header;
  std::string child;
  RosPose pose;
};

/// sensor_msgs/Image without padding between the rows.
struct RosImage {
  RosHeader header;
  int width = 0;
  int height = 0;
  std::string encoding;
  std::string bytes;
};

/// sensor_msgs/CompressedImage.
struct RosCompressedImage {
  RosHeader header;
  std::string format;
  std::string bytes;
};

/// sensor_msgs/CameraInfo; matrices row by row.
struct RosCameraInfo {
  RosHeader header;
  int width = 0;
  int height = 0;
  std::string model = "plumb_bob";
  std::vector<double> D;  ///< plumb_bob: k1, k2, p1, p2, k3; equidistant: k1, k2, k3, k4
  std::array<double, 9> K{};
  std::array<double, 9> R{};
  std::array<double, 12> P{};
};

/// sensor_msgs/Imu without orientation. The variances apply to each axis.
struct RosImu {
  RosHeader header;
  RosVector angular_velocity{};
  RosVector linear_acceleration{};
  double angular_velocity_variance = 0;
  double linear_acceleration_variance = 0;
};

/// sensor_msgs/JointState without effort.
struct RosJointState {
  RosHeader header;
  std::vector<std::string> names;
  std::vector<double> positions;
  std::vector<double> velocities;
};

/// nav_msgs/Odometry; the velocities are in the child's axes.
struct RosOdometry {
  RosHeader header;
  std::string child;
  RosPose pose;
  RosVector velocity{};
  RosVector angular_velocity{};
};

}  // namespace vinebench::harness
