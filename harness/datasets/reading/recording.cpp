// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/recording.h"

#include <algorithm>
#include <utility>

#include "core/util/error.h"
#include "harness/datasets/reading/kalibr_chain.h"

namespace vinebench::harness {

void set_rig(const std::filesystem::path& file, std::size_t cameras, Recording& recording) {
  KalibrChain given;
  if (is_kalibr_chain(file)) {
    given = load_kalibr_chain(file);
  } else {
    given.rig = load_rig(file);
  }
  if (given.rig.cameras.size() > cameras) {
    fail("{}: rig '{}' has {} cameras, the recording has {}", file.string(), given.rig.name,
         given.rig.cameras.size(), cameras);
  }
  recording.rig = std::move(given.rig);
  recording.image_delays = std::move(given.image_delays);
}

void delay_images(Recording& recording) {
  const std::vector<Stamp> delays = std::exchange(recording.image_delays, {});
  if (delays.empty()) return;
  const bool alike = std::ranges::count(delays, delays.front()) == std::ssize(delays);
  for (RecordedFrame& frame : recording.frames) {
    std::vector<Stamp>& stamps = frame.image_stamps;
    if (stamps.empty() && !alike) stamps.assign(frame.images.size(), frame.stamp);
    for (std::size_t camera = 0; camera < stamps.size(); ++camera) stamps[camera] += delays[camera];
    frame.stamp += delays.front();
  }
}

}  // namespace vinebench::harness
