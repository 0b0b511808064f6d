// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "harness/datasets/ros/messages/ros_output.h"
#include "harness/datasets/ros2/mcap/mcap_writer.h"

namespace vinebench::harness {

/// A bag of ROS 2 in a folder: an MCAP file and, when it is closed, metadata.yaml, by which ROS 2
/// and its tools read the folder.
class McapOutput : public RosOutput {
 public:
  /// `start`, ns: what the times of messages are ahead of a recording's stamps, for our own reader.
  McapOutput(const std::filesystem::path& file, std::int64_t start);
  /// Closes it if possible.
  ~McapOutput() override;
  McapOutput(const McapOutput&) = delete;
  McapOutput& operator=(const McapOutput&) = delete;

  void write_clock(const std::string& topic, std::int64_t time) override;
  void write_transforms(const std::string& topic,
                        const std::vector<RosTransform>& transforms) override;
  void write_latched(const std::string& topic,
                     const std::vector<RosTransform>& transforms) override;
  void write(const std::string& topic, const RosImage& image) override;
  void write(const std::string& topic, const RosCompressedImage& image) override;
  void write(const std::string& topic, const RosCameraInfo& info) override;
  void write(const std::string& topic, const RosImu& reading) override;
  void write(const std::string& topic, const RosJointState& reading) override;
  void write(const std::string& topic, const RosOdometry& odometry) override;
  void end_chunk() override;
  void close() override;

 private:
  void put(const std::string& topic, const char* type, std::int64_t time,
           const std::string& message, bool latched = false);

  std::filesystem::path file_;
  McapWriter out_;
  bool closed_ = false;
  std::map<std::string, std::size_t> channels_;  ///< by topic
};

}  // namespace vinebench::harness
