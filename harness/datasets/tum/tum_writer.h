// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "harness/datasets/files/append_file.h"
#include "harness/datasets/format/format_writer.h"

namespace vinebench::harness {

/// True trajectories in TUM format, `t x y z qx qy qz qw`: body.txt, and one file for each camera.
class TumWriter : public FormatWriter {
 public:
  TumWriter(const std::filesystem::path& folder, const RecordingNotes& notes);

  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>&) override { return {}; }
  void commit(const DatasetFrame& frame) override;

 private:
  std::vector<Pose> T_body_sensor_;
  std::vector<AppendFile> files_;  ///< of these sensors
};

}  // namespace vinebench::harness
