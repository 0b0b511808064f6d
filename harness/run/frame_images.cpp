// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/run/frame_images.h"

#include <algorithm>
#include <string_view>

#include "core/files/files.h"
#include "harness/datasets/files/image_codec.h"

namespace vinebench::harness {

FrameImages::FrameImages(std::filesystem::path folder, const Rig& rig, std::int64_t total,
                         int count)
    : folder_(std::move(folder)) {
  for (const RigCamera& camera : rig.cameras) cameras_.push_back(camera.name);
  const std::int64_t steps = std::max(1, count - 1);
  for (std::int64_t i = 0; i < count; ++i)
    chosen_.insert(i * std::max<std::int64_t>(0, total - 1) / steps);
}

void FrameImages::on_tick(const Sample& sample, const Estimate&) {
  if (!chosen_.contains(sample.frame.index)) return;
  for (std::size_t i = 0; i < sample.frame.images.size(); ++i) {
    if (sample.frame.images[i].empty()) continue;
    write_file_atomically(folder_ / fmt::format("{:06}_{}.png", sample.frame.index, cameras_.at(i)),
                          encode_png(sample.frame.images[i], PngContent::kNoise));
  }
}

}  // namespace vinebench::harness
