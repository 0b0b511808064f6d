// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/files/append_file.h"
#include "harness/datasets/format/format_writer.h"

namespace vinebench::harness {

/// DC-VSLAM's input without ROS (its programs SingleCam and DualCam, run in this folder):
/// config.yaml, the images of the first pair in left and right, of a second one in leftBack and
/// rightBack; and tags.csv, which is truth and not a detector's output: the tags that are
/// completely in view, with their true poses and corners (bottom left first, then anticlockwise,
/// px).
class DcvslamWriter : public FormatWriter {
 public:
  /// Throws Error for a rig without a pair, or with one that is not rectified.
  DcvslamWriter(const std::filesystem::path& folder, const RecordingNotes& notes, bool colour);

  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;
  void commit(const DatasetFrame& frame) override;

 private:
  void append_tags(const DatasetFrame& frame);

  std::filesystem::path folder_;
  bool colour_;
  RecordingNotes notes_;
  Rig rig_;
  AppendFile tags_;
};

}  // namespace vinebench::harness
