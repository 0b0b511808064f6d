// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/rig.h"
#include "core/time.h"
#include "harness/datasets/files/text_table.h"

namespace vinebench::harness {

/// A fault found by a check: a file, relative to the data set, and the problem.
struct DatasetFault {
  std::string file;
  std::string problem;
};

/// Lists all frames, in the folder of a recording.
inline constexpr const char* kRecordedFrames = "frames.csv";

/// A line of it.
struct RecordedPose {
  Stamp stamp = 0;
  Pose T_world_body;
};

/// A sequence that was recorded, as its checks know it.
struct RecordedSequence {
  std::filesystem::path folder;
  bool complete = true;  ///< false after an interruption
  std::vector<RecordedPose> frames;
  Rig rig;             ///< the cameras as they truly are: calibration.yaml
  bool windy = false;  ///< plants move by themselves
  bool busy = false;   ///< occluders move

  /// Whether it has a file or folder of this name.
  bool has(const std::string& name) const;

  /// Rows of a list; of an interrupted recording without a line that was cut off. Throws Error.
  std::vector<TableRow> read(const std::string& list) const;
};

/// Adds a fault where a list does not have a line for each frame; that of an interrupted recording
/// may be a frame ahead.
void expect_rows(const RecordedSequence& sequence, const std::string& list, std::size_t rows,
                 std::vector<DatasetFault>& faults);

}  // namespace vinebench::harness
