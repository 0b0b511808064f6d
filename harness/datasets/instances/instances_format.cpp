// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/instances/instances_format.h"

#include "core/truth/labels.h"
#include "harness/datasets/instances/instances_writer.h"

namespace vinebench::harness {

namespace {

std::unique_ptr<FormatWriter> make_instances_writer(const WriterInputs& inputs) {
  return std::make_unique<InstanceWriter>(inputs.folder, inputs.notes, inputs.scene);
}

/// Bunches are where semantic has bunches.
void check_instances_image(LabelImages& images) {
  const cv::Mat& instances = images.read("instances", CV_8UC3);
  const cv::Mat& semantic = images.read("semantic", CV_8UC1);
  if (instances.empty() || semantic.empty()) return;
  images.expect_none(
      "instances", instances.size(), "has bunches where semantic has none", [&](int y, int x) {
        const cv::Vec3b& id = instances.at<cv::Vec3b>(y, x);  // blue, green, red
        const bool part = id[2] != 0 && (id[0] != 0 || id[1] != 0);
        const bool bunch =
            semantic.at<std::uint8_t>(y, x) == static_cast<std::uint8_t>(Label::kBunch);
        return part && !bunch;
      });
}

}  // namespace

DatasetFormat instances_format() {
  return {.name = "instances",
          .description = "numbers of instances, PNG, with a table of what they are",
          .truth = {.instances = true},
          .write = make_instances_writer,
          .check_image = check_instances_image};
}

}  // namespace vinebench::harness
