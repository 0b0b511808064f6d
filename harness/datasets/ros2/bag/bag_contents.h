// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/frame.h"
#include "core/time.h"
#include "harness/datasets/ros/messages/ros_messages.h"
#include "harness/datasets/ros2/bag/bag_file.h"

namespace vinebench::harness {

/// A topic of images.
struct BagImages {
  struct Entry {
    Stamp stamp = 0;
    std::size_t file = 0;  ///< of the bag
    MessagePlace place;
  };
  std::string type;
  std::string frame;   ///< of the first image
  std::string coding;  ///< encoding, or the format of compressed images, of the first one
  std::vector<Entry> entries;
};

/// A topic of inertial readings, in the sensor's own axes.
struct BagInertial {
  std::string frame;
  std::vector<ImuSample> readings;
};

/// What a replay needs of a bag; its images stay on the disk. Stamps are those of the messages'
/// headers; in a recording of ours without what times of ROS are ahead of them.
struct BagContents {
  std::vector<std::filesystem::path> names;  ///< of the files
  std::vector<std::shared_ptr<BagFile>> files;
  std::map<std::string, std::string> topics;     ///< types of all, by name
  std::map<std::string, BagImages> images;       ///< by topic
  std::map<std::string, RosCameraInfo> cameras;  ///< the first message, by topic
  std::map<std::string, BagInertial> inertial;   ///< by topic
  std::vector<RosTransform> mounts;              ///< of /tf_static
  std::vector<WheelSample> wheels;               ///< of /joint_states
  std::vector<RosTransform> truth;               ///< of /ground_truth
  bool ours = false;                             ///< a recording of ours, by its own record
  std::string cut_off;                           ///< what a file that ends too early lacks
};

/// Throws Error that names file, topic and place for what cannot be read.
BagContents scan_bag(const std::vector<std::filesystem::path>& files);

}  // namespace vinebench::harness
