// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "harness/datasets/files/append_file.h"
#include "harness/datasets/format/format_writer.h"

namespace vinebench::harness {

/// KITTI odometry of the first pair: image_0 and image_1 (grey), with colour image_2 and image_3
/// too, calib.txt (P0 to P3), times.txt (s), poses.txt (the left camera relative to its first
/// pose); and our extensions: rig.yaml with the pair only, slam.yaml.
class KittiWriter : public FormatWriter {
 public:
  /// Throws Error for a rig without a pair, or with one that is not rectified.
  KittiWriter(const std::filesystem::path& folder, const RecordingNotes& notes, bool colour);

  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;
  void commit(const DatasetFrame& frame) override;

 private:
  std::filesystem::path folder_;
  bool colour_;
  StereoPair pair_;
  Pose T_body_left_;  ///< true
  AppendFile times_;
  AppendFile poses_;
  std::optional<Pose> T_world_first_;
};

}  // namespace vinebench::harness
