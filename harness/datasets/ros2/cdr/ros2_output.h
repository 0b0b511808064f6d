// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/ros/messages/ros_output.h"

namespace vinebench::harness {

/// A message of ROS 2 in CDR.
struct Ros2Message {
  std::string topic;
  std::string type;  ///< as in bags, "sensor_msgs/msg/Image"
  std::int64_t time = 0;
  std::string bytes;
  bool latched = false;  ///< also for those who subscribe later
};

/// Encodes what is written, for a bag or for topics.
class Ros2Output : public RosOutput {
 public:
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

 protected:
  virtual void put(Ros2Message message) = 0;
};

}  // namespace vinebench::harness
