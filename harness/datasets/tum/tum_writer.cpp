// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/tum/tum_writer.h"

#include "core/trajectory.h"

namespace vinebench::harness {

TumWriter::TumWriter(const std::filesystem::path& folder, const RecordingNotes& notes) {
  make_folder(folder);
  T_body_sensor_.emplace_back();
  files_.emplace_back(folder / "body.txt");
  for (const RigCamera& camera : notes.true_cameras) {
    T_body_sensor_.push_back(camera.T_body_cam);
    files_.emplace_back(folder / (camera.name + ".txt"));
  }
}

void TumWriter::commit(const DatasetFrame& frame) {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const Pose T_world_sensor = frame.truth.T_world_body * T_body_sensor_[i];
    files_[i].append(format_tum({{frame.frame.stamp, T_world_sensor}}));
  }
}

}  // namespace vinebench::harness
