// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Compiled as C++17 too, as ROS's headers have to be: nothing of ours that is C++20 goes in here.

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace vinebench::harness {

using RosVector = std::array<double, 3>;
using RosQuaternion = std::array<double, 4>;  ///< x, y, z, w

struct RosHeader {
  std::int64_t time = 0;  ///< ns, above 0
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
  std::array<double, 5> D{};
  std::array<double, 9> K{};
  std::array<double, 9> R{};
  std::array<double, 12> P{};
};

/// sensor_msgs/Imu without orientation. The variances hold for each axis.
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

/// A bag of ROS 1 that is written message after message, in the order of their times. It has
/// ".active" at the end of its name until it is closed. What goes wrong throws Error; before a
/// message that the disk has no room for, so that the bag can be closed nevertheless.
class RosBag {
 public:
  /// Throws Error where the file cannot be written, and where the program was built without ROS's
  /// libraries.
  explicit RosBag(const std::filesystem::path& file);
  /// Closes it, where that goes.
  ~RosBag();
  RosBag(const RosBag&) = delete;
  RosBag& operator=(const RosBag&) = delete;

  void write_clock(const std::string& topic, std::int64_t time);
  /// All of one time.
  void write_transforms(const std::string& topic, const std::vector<RosTransform>& transforms);
  /// The same, for who comes later too: rosbag play latches it.
  void write_latched(const std::string& topic, const std::vector<RosTransform>& transforms);
  void write(const std::string& topic, const RosImage& image);
  void write(const std::string& topic, const RosCompressedImage& image);
  void write(const std::string& topic, const RosCameraInfo& info);
  void write(const std::string& topic, const RosImu& reading);
  void write(const std::string& topic, const RosJointState& reading);
  void write(const std::string& topic, const RosOdometry& odometry);

  /// What was written since is whole on its way to the disk: a chunk that `rosbag reindex` finds
  /// even where the bag is never closed.
  void end_chunk();

  /// Writes the index and gives the bag its name.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether the program was built with ROS's libraries.
bool has_rosbag();

}  // namespace vinebench::harness
