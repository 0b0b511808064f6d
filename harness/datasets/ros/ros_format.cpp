// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros/ros_format.h"

#include "harness/datasets/ros/ros_writer.h"

namespace vinebench::harness {

DatasetFormat ros_format() {
  return {.name = "ros",
          .description = "a bag of ROS 1, run.bag",
          .available = has_rosbag(),
          .write = [](const WriterInputs& inputs) {
            return std::make_unique<RosWriter>(inputs.folder, inputs.notes, inputs.options.colour,
                                               inputs.options.images);
          }};
}

}  // namespace vinebench::harness
