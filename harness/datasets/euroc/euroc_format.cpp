// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/euroc_format.h"

#include <set>

#include "harness/datasets/euroc/euroc_reader.h"
#include "harness/datasets/euroc/euroc_writer.h"
#include "harness/datasets/files/text_table.h"

namespace vinebench::harness {

namespace {

std::unique_ptr<FormatWriter> make_euroc_writer(const WriterInputs& inputs) {
  return std::make_unique<EurocWriter>(inputs.folder, inputs.notes, inputs.options.colour);
}

/// Images that are listed are there, at the stamps of frames.
void check_camera(const RecordedSequence& sequence, const std::string& camera,
                  std::vector<DatasetFault>& faults) {
  std::set<Stamp> stamps;
  for (const RecordedPose& frame : sequence.frames) stamps.insert(frame.stamp);
  const std::string list = camera + "/data.csv";
  for (const TableRow& row : sequence.read(list)) {
    row.expect_columns(2, "timestamp [ns], filename");
    if (sequence.complete && !stamps.contains(row.nanoseconds(0))) {
      faults.push_back({list, fmt::format("{}: no frame has this stamp", row.fields[0])});
    }
    if (!sequence.has(camera + "/data/" + row.fields[1])) {
      faults.push_back({list, fmt::format("{}: image is missing", row.fields[1])});
    }
  }
}

/// Poses at the inertial unit's rate, and one of each frame.
void check_truth(const RecordedSequence& sequence, std::vector<DatasetFault>& faults) {
  const std::string list = "euroc/mav0/state_groundtruth_estimate0/data.csv";
  std::set<Stamp> stamps;
  for (const TableRow& row : sequence.read(list)) {
    row.expect_columns(17, "EuRoC's");
    const Stamp stamp = row.nanoseconds(0);
    if (!stamps.empty() && stamp <= *stamps.rbegin()) {
      faults.push_back({list, fmt::format("{}: stamp does not ascend", stamp)});
    }
    stamps.insert(stamp);
  }
  if (!sequence.complete) return;  // a pose is written with the next one
  for (const RecordedPose& frame : sequence.frames) {
    if (stamps.contains(frame.stamp)) continue;
    faults.push_back({list, fmt::format("{}: no pose of this frame", frame.stamp)});
  }
}

void check_euroc_lists(const RecordedSequence& sequence, std::vector<DatasetFault>& faults) {
  const std::string frames = "euroc/frames.csv";
  expect_rows(sequence, frames, sequence.read(frames).size(), faults);
  for (int i = 0; sequence.has(fmt::format("euroc/mav0/cam{}", i)); ++i) {
    check_camera(sequence, fmt::format("euroc/mav0/cam{}", i), faults);
  }
  check_truth(sequence, faults);
}

}  // namespace

DatasetFormat euroc_format() {
  return {.name = "euroc",
          .description = "EuRoC/ASL folder with settings for other SLAM systems",
          .write = make_euroc_writer,
          .reader = {"an EuRoC/ASL folder (mav0/cam0 with data.csv and sensor.yaml)", is_euroc,
                     read_euroc},
          .check = check_euroc_lists};
}

}  // namespace vinebench::harness
