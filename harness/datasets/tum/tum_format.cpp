// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/tum/tum_format.h"

#include "core/trajectory.h"
#include "harness/datasets/files/file_manifest.h"
#include "harness/datasets/tum/tum_writer.h"

namespace vinebench::harness {

namespace {

std::unique_ptr<FormatWriter> make_tum_writer(const WriterInputs& inputs) {
  return std::make_unique<TumWriter>(inputs.folder, inputs.notes);
}

void check_tum_lists(const RecordedSequence& sequence, std::vector<DatasetFault>& faults) {
  const std::filesystem::path folder = sequence.folder / "tum";
  for (const std::string& name : files_below(folder)) {
    const std::string list = "tum/" + name;
    const std::size_t rows =
        sequence.complete ? read_tum(folder / name).size() : sequence.read(list).size();
    expect_rows(sequence, list, rows, faults);
  }
}

}  // namespace

DatasetFormat tum_format() {
  return {.name = "tum",
          .description = "true trajectories of the body and of each camera",
          .write = make_tum_writer,
          .check = check_tum_lists};
}

}  // namespace vinebench::harness
