// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/format/image_writer.h"

#include <fmt/format.h>

namespace vinebench::harness {

namespace fs = std::filesystem;

bool delivered(const DatasetFrame& frame, std::size_t camera) {
  return !frame.frame.images.at(camera).empty();
}

const RenderedImage& truth_of(const DatasetFrame& frame, std::size_t camera) {
  return frame.truth.views.at(camera).image;
}

std::vector<std::string> make_camera_folders(const fs::path& folder, const RecordingNotes& notes) {
  std::vector<std::string> names;
  for (const RigConfig::Camera& camera : notes.rig.cameras) {
    make_folder(folder / camera.name);
    names.push_back(camera.name);
  }
  return names;
}

ImageWriter::ImageWriter(const fs::path& folder, const RecordingNotes& notes, std::string name,
                         std::string ending, Encode encode)
    : folder_(folder),
      cameras_(make_camera_folders(folder, notes)),
      name_(std::move(name)),
      ending_(std::move(ending)),
      encode_(std::move(encode)) {}

std::vector<FileTask> ImageWriter::files(const std::shared_ptr<const DatasetFrame>& frame) {
  std::vector<FileTask> tasks;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!delivered(*frame, i)) continue;
    tasks.push_back({fmt::format("{} {} {}", name_, ending_, i),
                     folder_ / cameras_[i] / numbered(frame->number, ending_),
                     [this, frame, i] { return encode_(*frame, i); }});
  }
  return tasks;
}

}  // namespace vinebench::harness
