// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0

// Replaces ros_bag.cpp if ROS's libraries are not installed.

#include "core/util/error.h"
#include "harness/datasets/ros/rosbag/ros_bag.h"

namespace vinebench::harness {

struct RosBag::Impl {};

RosBag::RosBag(const std::filesystem::path&) {
  fail(
      "ros: this program was built without ROS's libraries; install librosbag-storage-dev, "
      "libsensor-msgs-dev, libnav-msgs-dev, libtf2-msgs-dev and libros-rosgraph-msgs-dev "
      "(tools/setup.sh --ros) and build it again");
}

RosBag::~RosBag() = default;
void RosBag::write_clock(const std::string&, std::int64_t) {}
void RosBag::write_transforms(const std::string&, const std::vector<RosTransform>&) {}
void RosBag::write_latched(const std::string&, const std::vector<RosTransform>&) {}
void RosBag::write(const std::string&, const RosImage&) {}
void RosBag::write(const std::string&, const RosCompressedImage&) {}
void RosBag::write(const std::string&, const RosCameraInfo&) {}
void RosBag::write(const std::string&, const RosImu&) {}
void RosBag::write(const std::string&, const RosJointState&) {}
void RosBag::write(const std::string&, const RosOdometry&) {}
void RosBag::end_chunk() {}
void RosBag::close() {}

bool has_rosbag() {
  return false;
}

}  // namespace vinebench::harness
