// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Also compiled as C++17, as required by ROS's headers: no C++20 here.

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

/// A ROS 1 bag, written message by message in order of time. Its name ends with ".active" until it
/// is closed. Throws Error; for a full disk before the message is written, so that the bag can
/// still be closed.
class RosBag {
 public:
  /// Throws Error if the file cannot be written, and if the program was built without ROS's
  /// libraries.
  explicit RosBag(const std::filesystem::path& file);
  /// Closes it if possible.
  ~RosBag();
  RosBag(const RosBag&) = delete;
  RosBag& operator=(const RosBag&) = delete;

  void write_clock(const std::string& topic, std::int64_t time);
  /// All transforms have the same time.
  void write_transforms(const std::string& topic, const std::vector<RosTransform>& transforms);
  /// The same, latched by rosbag play.
  void write_latched(const std::string& topic, const std::vector<RosTransform>& transforms);
  void write(const std::string& topic, const RosImage& image);
  void write(const std::string& topic, const RosCompressedImage& image);
  void write(const std::string& topic, const RosCameraInfo& info);
  void write(const std::string& topic, const RosImu& reading);
  void write(const std::string& topic, const RosJointState& reading);
  void write(const std::string& topic, const RosOdometry& odometry);

  /// Completes and flushes the current chunk, so that `rosbag reindex` finds it even if the bag is
  /// never closed.
  void end_chunk();

  /// Writes the index and renames the bag.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether the program was built with ROS's libraries.
bool has_rosbag();

}  // namespace vinebench::harness
