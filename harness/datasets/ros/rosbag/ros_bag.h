// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Also compiled as C++17, as required by ROS's headers: no C++20 here.

#include <filesystem>
#include <memory>

#include "harness/datasets/ros/messages/ros_output.h"

namespace vinebench::harness {

/// A ROS 1 bag. Its name ends with ".active" until it is closed.
class RosBag : public RosOutput {
 public:
  /// Throws Error if the file cannot be written, and if the program was built without ROS's
  /// libraries.
  explicit RosBag(const std::filesystem::path& file);
  /// Closes it if possible.
  ~RosBag() override;
  RosBag(const RosBag&) = delete;
  RosBag& operator=(const RosBag&) = delete;

  void write_clock(const std::string& topic, std::int64_t time) override;
  void write_transforms(const std::string& topic,
                        const std::vector<RosTransform>& transforms) override;
  /// Latched by rosbag play.
  void write_latched(const std::string& topic,
                     const std::vector<RosTransform>& transforms) override;
  void write(const std::string& topic, const RosImage& image) override;
  void write(const std::string& topic, const RosCompressedImage& image) override;
  void write(const std::string& topic, const RosCameraInfo& info) override;
  void write(const std::string& topic, const RosImu& reading) override;
  void write(const std::string& topic, const RosJointState& reading) override;
  void write(const std::string& topic, const RosOdometry& odometry) override;

  /// Flushes the chunk, so that `rosbag reindex` finds it.
  void end_chunk() override;
  /// Writes the index and renames the bag.
  void close() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether the program was built with ROS's libraries.
bool has_rosbag();

}  // namespace vinebench::harness
