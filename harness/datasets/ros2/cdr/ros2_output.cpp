// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/cdr/ros2_output.h"

#include "harness/datasets/ros2/cdr/ros2_messages.h"

namespace vinebench::harness {

void Ros2Output::write_clock(const std::string& topic, std::int64_t time) {
  put({topic, ros2::kClock, time, encode_clock(time)});
}

void Ros2Output::write_transforms(const std::string& topic,
                                  const std::vector<RosTransform>& transforms) {
  if (transforms.empty()) return;
  put({topic, ros2::kTransforms, transforms.front().header.time, encode(transforms)});
}

void Ros2Output::write_latched(const std::string& topic,
                               const std::vector<RosTransform>& transforms) {
  if (transforms.empty()) return;
  put({topic, ros2::kTransforms, transforms.front().header.time, encode(transforms), true});
}

void Ros2Output::write(const std::string& topic, const RosImage& image) {
  put({topic, ros2::kImage, image.header.time, encode(image)});
}

void Ros2Output::write(const std::string& topic, const RosCompressedImage& image) {
  put({topic, ros2::kCompressedImage, image.header.time, encode(image)});
}

void Ros2Output::write(const std::string& topic, const RosCameraInfo& info) {
  put({topic, ros2::kCameraInfo, info.header.time, encode(info)});
}

void Ros2Output::write(const std::string& topic, const RosImu& reading) {
  put({topic, ros2::kImu, reading.header.time, encode(reading)});
}

void Ros2Output::write(const std::string& topic, const RosJointState& reading) {
  put({topic, ros2::kJointState, reading.header.time, encode(reading)});
}

void Ros2Output::write(const std::string& topic, const RosOdometry& odometry) {
  put({topic, ros2::kOdometry, odometry.header.time, encode(odometry)});
}

}  // namespace vinebench::harness
