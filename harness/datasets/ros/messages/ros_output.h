// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Also compiled as C++17, as required by ROS's headers: no C++20 here.

#include "harness/datasets/ros/messages/ros_messages.h"

namespace vinebench::harness {

/// A bag that is written message by message in order of time, whichever version of ROS reads it.
/// Throws Error; for a full disk while there still is room for the index, so that the bag can be
/// closed.
class RosOutput {
 public:
  virtual ~RosOutput() = default;

  virtual void write_clock(const std::string& topic, std::int64_t time) = 0;
  /// All transforms have the same time.
  virtual void write_transforms(const std::string& topic,
                                const std::vector<RosTransform>& transforms) = 0;
  /// The same, for subscribers that come later too.
  virtual void write_latched(const std::string& topic,
                             const std::vector<RosTransform>& transforms) = 0;
  virtual void write(const std::string& topic, const RosImage& image) = 0;
  virtual void write(const std::string& topic, const RosCompressedImage& image) = 0;
  virtual void write(const std::string& topic, const RosCameraInfo& info) = 0;
  virtual void write(const std::string& topic, const RosImu& reading) = 0;
  virtual void write(const std::string& topic, const RosJointState& reading) = 0;
  virtual void write(const std::string& topic, const RosOdometry& odometry) = 0;

  /// Completes the current chunk, so that its messages are found even if the bag is never closed.
  virtual void end_chunk() = 0;
  /// Writes the index.
  virtual void close() = 0;
};

}  // namespace vinebench::harness
