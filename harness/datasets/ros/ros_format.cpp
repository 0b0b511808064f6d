// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros/ros_format.h"

#include "harness/datasets/ros/ros_writer.h"
#include "harness/datasets/ros/rosbag/ros_bag.h"

namespace vinebench::harness {

DatasetFormat ros_format() {
  return {.name = "ros",
          .description = "a bag of ROS 1, run.bag",
          .available = has_rosbag(),
          .write = [](const WriterInputs& inputs) {
            auto bag = std::make_unique<RosBag>(make_folder(inputs.folder) / "run.bag");
            return std::make_unique<RosWriter>(std::move(bag), inputs.notes, inputs.options.colour,
                                               inputs.options.images);
          }};
}

}  // namespace vinebench::harness
