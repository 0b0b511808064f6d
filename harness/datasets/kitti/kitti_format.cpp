// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/kitti/kitti_format.h"

#include "harness/datasets/files/text_table.h"
#include "harness/datasets/kitti/kitti_raw_reader.h"
#include "harness/datasets/kitti/kitti_reader.h"
#include "harness/datasets/kitti/kitti_writer.h"

namespace vinebench::harness {

namespace {

std::unique_ptr<FormatWriter> make_kitti_writer(const WriterInputs& inputs) {
  return std::make_unique<KittiWriter>(inputs.folder, inputs.notes, inputs.options.colour);
}

void check_kitti_lists(const RecordedSequence& sequence, std::vector<DatasetFault>& faults) {
  for (const char* list : {"kitti/times.txt", "kitti/poses.txt"}) {
    expect_rows(sequence, list, sequence.read(list).size(), faults);
  }
}

Recording read_either(const std::filesystem::path& folder, const RecordingOptions& options) {
  return is_kitti(folder) ? read_kitti(folder, options) : read_kitti_raw(folder, options);
}

}  // namespace

DatasetFormat kitti_format() {
  return {
      .name = "kitti",
      .description = "KITTI odometry folder of the first pair",
      .write = make_kitti_writer,
      .reader = {"a KITTI odometry folder (calib.txt beside image_0 and image_1, image_2 and "
                 "image_3, or image_l and image_r) or a drive of KITTI's raw data (image_00/data)",
                 [](const std::filesystem::path& folder) {
                   return is_kitti(folder) || is_kitti_raw(folder);
                 },
                 read_either},
      .check = check_kitti_lists};
}

}  // namespace vinebench::harness
