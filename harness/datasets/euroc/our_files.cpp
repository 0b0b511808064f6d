// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/euroc/our_files.h"

#include "core/config/yaml_writer.h"
#include "core/files/files.h"
#include "core/files/input_file.h"
#include "core/util/error.h"
#include "harness/datasets/euroc/tag_list.h"
#include "harness/datasets/files/text_table.h"

namespace vinebench::harness {

void write_our_files(const std::filesystem::path& folder, const RecordingNotes& notes) {
  write_file_atomically(folder / "rig.yaml", format_yaml(notes.rig));
  write_file_atomically(folder / "tags.yaml", format_tags(notes.tags));
  write_file_atomically(folder / "slam.yaml", format_yaml(notes.slam));
}

std::vector<Stamp> read_frame_list(const std::filesystem::path& file) {
  std::vector<Stamp> instants;
  for (const TableRow& row : read_table(file)) {
    instants.push_back(row.nanoseconds(0));
    if (instants.size() > 1 && instants.back() <= instants[instants.size() - 2]) {
      row.fault("expected a later stamp than the line before");
    }
  }
  if (instants.empty()) fail("{}: expected a line for each frame, found none", file.string());
  return instants;
}

void read_tags_and_settings(const std::filesystem::path& folder, Recording& recording) {
  if (is_present(folder / "tags.yaml")) recording.tags = read_tags(folder / "tags.yaml");
  if (is_present(folder / "slam.yaml")) recording.settings = folder / "slam.yaml";
}

}  // namespace vinebench::harness
