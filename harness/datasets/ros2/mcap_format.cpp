// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/mcap_format.h"

#include <fmt/format.h>

#include "harness/datasets/euroc/our_files.h"
#include "harness/datasets/files/append_file.h"
#include "harness/datasets/files/dataset_folder.h"
#include "harness/datasets/ros/ros_writer.h"
#include "harness/datasets/ros2/bag/bag_metadata.h"
#include "harness/datasets/ros2/bag/bag_reader.h"
#include "harness/datasets/ros2/mcap/mcap_output.h"

namespace vinebench::harness {
namespace {

/// A bag with the messages of ROS 1's, and beside it what our replay needs more.
class McapRecording : public RosWriter {
 public:
  explicit McapRecording(const WriterInputs& inputs)
      : RosWriter(std::make_unique<McapOutput>(make_folder(inputs.folder) / "run.mcap", kRosStart),
                  inputs.notes, inputs.options.colour, inputs.options.images),
        frames_(inputs.folder / kFrameList) {
    frames_.append(kFrameListHeader);
    write_our_files(inputs.folder, inputs.notes);
  }

  void commit(const DatasetFrame& frame) override {
    RosWriter::commit(frame);
    frames_.append(fmt::format("{}\n", frame.frame.stamp));
  }

 private:
  AppendFile frames_;
};

/// Frames of the list are those of the sequence.
void check_mcap_lists(const RecordedSequence& sequence, std::vector<DatasetFault>& faults) {
  const std::string frames = fmt::format("mcap/{}", kFrameList);
  expect_rows(sequence, frames, sequence.read(frames).size(), faults);
}

}  // namespace

DatasetFormat mcap_format() {
  return {
      .name = "mcap",
      .description = "a bag of ROS 2 with run.mcap",
      .write = [](const WriterInputs& inputs) { return std::make_unique<McapRecording>(inputs); },
      .reader = {"a bag of ROS 2 (.mcap or .db3, or a folder with these)", is_bag, read_bag, true},
      .check = check_mcap_lists};
}

}  // namespace vinebench::harness
