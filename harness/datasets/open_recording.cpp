// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/open_recording.h"

#include <fmt/ranges.h>

#include <system_error>

#include "core/util/error.h"
#include "harness/datasets/format/dataset_card.h"
#include "harness/datasets/formats.h"
#include "harness/datasets/reading/groundtruth.h"
#include "harness/datasets/reading/recorded_images.h"

namespace vinebench::harness {
namespace {

namespace fs = std::filesystem;

/// The layouts of all readable formats, for messages.
std::string known_layouts() {
  std::vector<std::string> layouts;
  for (const DatasetFormat& format : dataset_formats()) {
    if (format.reader.read) layouts.push_back(format.reader.layout);
  }
  return fmt::format("{}", fmt::join(layouts, " or "));
}

/// The format whose reader detects a folder; null if none does.
const DatasetFormat* format_of(const fs::path& folder) {
  for (const DatasetFormat& format : dataset_formats()) {
    if (format.reader.read && format.reader.recognises(folder)) return &format;
  }
  return nullptr;
}

/// The first readable image of each camera must have the size of its calibration.
void check_sizes(const Recording& recording) {
  for (std::size_t camera = 0; camera < recording.rig.cameras.size(); ++camera) {
    const RigCamera& expected = recording.rig.cameras[camera];
    const cv::Size size = first_image_size(recording, camera);
    if (size.empty()) continue;
    if (size.width != expected.model.width || size.height != expected.model.height) {
      fail("{}: camera '{}': its calibration is for {} x {} pixels, its first image has {} x {}",
           recording.name, expected.name, expected.model.width, expected.model.height, size.width,
           size.height);
    }
  }
}

/// A data set of ours has one folder for each format.
fs::path readable_part(const fs::path& folder) {
  if (format_of(folder) != nullptr || !has_card(folder)) return folder;
  std::error_code ignored;
  for (const DatasetFormat& format : dataset_formats()) {
    if (format.reader.read && fs::is_directory(folder / format.name, ignored)) {
      return folder / format.name;
    }
  }
  return folder;
}

}  // namespace

Recording open_recording(const fs::path& named, const RecordingOptions& options) {
  std::error_code ignored;
  if (!fs::exists(named, ignored)) {
    fail("{}: expected a folder or a file: {}", named.string(), known_layouts());
  }
  const fs::path folder = readable_part(named);
  const DatasetFormat* format = format_of(folder);
  if (format == nullptr) {
    fail("{}: is not a recording: expected {}", folder.string(), known_layouts());
  }
  if (!options.topics.empty() && !format->reader.topics) {
    fail("{}: is {}: --topics are a bag's", folder.string(), format->reader.layout);
  }
  Recording recording = format->reader.read(folder, options);
  recording.name = fs::weakly_canonical(named).filename().string();
  if (recording.name == "mav0") {
    recording.name = fs::weakly_canonical(named).parent_path().filename().string();
  }
  if (recording.frames.empty()) fail("{}: has no images", folder.string());
  delay_images(recording);
  if (!options.groundtruth.empty()) {
    recording.truth = read_groundtruth(options.groundtruth, recording);
  }
  check_sizes(recording);
  return recording;
}

}  // namespace vinebench::harness
