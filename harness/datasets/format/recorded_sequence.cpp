// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/recorded_sequence.h"

#include <fmt/format.h>

#include <system_error>

namespace vinebench::harness {

bool RecordedSequence::has(const std::string& name) const {
  std::error_code ignored;
  return std::filesystem::exists(folder / name, ignored);
}

std::vector<TableRow> RecordedSequence::read(const std::string& list) const {
  return complete ? read_rows(folder / list) : read_ended_rows(folder / list);
}

void expect_rows(const RecordedSequence& sequence, const std::string& list, std::size_t rows,
                 std::vector<DatasetFault>& faults) {
  const std::size_t frames = sequence.frames.size();
  if (rows == frames || (!sequence.complete && rows >= frames && rows <= frames + 1)) return;
  faults.push_back(
      {list, fmt::format("has {} lines, expected one for each of {} frames", rows, frames)});
}

}  // namespace vinebench::harness
