// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/recording_notes.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "core/util/error.h"

namespace vinebench::harness {

RecordingNotes with_cameras(RecordingNotes notes, const std::vector<std::string>& names) {
  if (names.empty()) return notes;
  RigConfig& rig = notes.rig;
  std::vector<std::string> known;
  for (const RigConfig::Camera& camera : rig.cameras) known.push_back(camera.name);
  for (const std::string& name : names) {
    if (std::ranges::count(known, name) > 0) continue;
    fail("camera '{}': rig '{}' has none of that name, expected some of {}", name, rig.name,
         fmt::join(known, ", "));
  }
  const auto left_out = [&](const std::string& name) {
    return std::ranges::count(names, name) == 0;
  };
  std::erase_if(rig.cameras, [&](const auto& camera) { return left_out(camera.name); });
  std::erase_if(rig.stereo_pairs,
                [&](const auto& pair) { return left_out(pair.left) || left_out(pair.right); });
  std::erase_if(rig.tag_cameras, left_out);
  std::erase_if(notes.true_cameras, [&](const auto& camera) { return left_out(camera.name); });
  return notes;
}

}  // namespace vinebench::harness
