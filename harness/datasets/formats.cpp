// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/formats.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "core/util/error.h"
#include "harness/datasets/coco/coco_format.h"
#include "harness/datasets/dcvslam/dcvslam_format.h"
#include "harness/datasets/depth/depth_format.h"
#include "harness/datasets/depth32/depth32_format.h"
#include "harness/datasets/disparity/disparity_format.h"
#include "harness/datasets/euroc/euroc_format.h"
#include "harness/datasets/flow/flow_format.h"
#include "harness/datasets/instances/instances_format.h"
#include "harness/datasets/kitti/kitti_format.h"
#include "harness/datasets/normals/normals_format.h"
#include "harness/datasets/rgb/rgb_format.h"
#include "harness/datasets/ros/ros_format.h"
#include "harness/datasets/ros2/bag/bag_metadata.h"
#include "harness/datasets/ros2/bag/bag_reader.h"
#include "harness/datasets/ros2/mcap_format.h"
#include "harness/datasets/semantic/semantic_format.h"
#include "harness/datasets/tum/tum_format.h"

namespace vinebench::harness {
namespace {

/// What reads bags of ROS 1 is with that of ROS 2.
DatasetFormat readable_ros_format() {
  DatasetFormat format = ros_format();
  format.reader = {"a bag of ROS 1 (.bag, or a folder with one)", is_ros1_bag, read_bag, true};
  return format;
}

}  // namespace

const std::vector<DatasetFormat>& dataset_formats() {
  static const std::vector<DatasetFormat> formats{
      euroc_format(),     kitti_format(), tum_format(),          dcvslam_format(),
      rgb_format(),       depth_format(), depth32_format(),      disparity_format(),
      flow_format(),      flo_format(),   normals_format(),      semantic_format(),
      instances_format(), coco_format(),  readable_ros_format(), mcap_format()};
  return formats;
}

const DatasetFormat& format_named(const std::string& name) {
  const auto found = std::ranges::find(dataset_formats(), name, &DatasetFormat::name);
  if (found == dataset_formats().end()) fail("unknown format '{}'", name);
  return *found;
}

std::vector<std::string> all_formats() {
  std::vector<std::string> names;
  for (const DatasetFormat& format : dataset_formats()) {
    if (format.available) names.push_back(format.name);
  }
  return names;
}

std::vector<std::string> parse_formats(const std::vector<std::string>& names) {
  std::vector<std::string> known;
  std::vector<std::string> formats;
  for (const DatasetFormat& format : dataset_formats()) {
    known.push_back(format.name);
    if (std::ranges::count(names, format.name) > 0) formats.push_back(format.name);
  }
  for (const std::string& name : names) {
    if (std::ranges::count(known, name) > 0) continue;
    fail("--format: unknown format '{}', expected some of {}", name, fmt::join(known, ", "));
  }
  if (formats.empty()) fail("--format: expected some of {}", fmt::join(known, ", "));
  return formats;
}

CapturePlan plan_of(const RecordOptions& options, const Rig& rig) {
  CapturePlan plan;
  plan.first = options.first;
  plan.last = options.last;
  plan.every = options.every;
  for (const std::string& name : options.formats) {
    const TruthImages& truth = format_named(name).truth;
    plan.labels = plan.labels || truth.labels;
    plan.depth = plan.depth || truth.depth;
    plan.normals = plan.normals || truth.normals;
    plan.motion = plan.motion || truth.motion;
    plan.instances = plan.instances || truth.instances;
  }
  plan.cameras = chosen_cameras(options.cameras, rig, "cameras to record");
  return plan;
}

}  // namespace vinebench::harness
