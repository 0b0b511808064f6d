// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/tags/tag_times.h"

#include <algorithm>
#include <memory>

#include "slam/tags/tag_sightings.h"

namespace vinebench::slam {

void take_tags_later(int camera, double seconds, const TagCameras& cameras, Map& map) {
  if (seconds == 0) return;
  for (std::size_t k = 0; k < map.keyframes().size(); ++k) {
    Keyframe& keyframe = map.keyframe(static_cast<int>(k));
    if (std::ranges::count(keyframe.frame->tags, camera, &TagSighting::camera) == 0) continue;
    const auto frame = std::make_shared<FrameFeatures>(*keyframe.frame);
    for (TagSighting& tag : frame->tags) {
      if (tag.camera != camera) continue;
      tag.late = seconds;
      bring_to_stamp(frame->velocity, cameras, tag);
    }
    keyframe.frame = frame;
  }
}

}  // namespace vinebench::slam
