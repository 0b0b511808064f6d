// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "harness/datasets/format/format_writer.h"

namespace vinebench::harness {

/// Writes one file of each camera's image or truth.
class ImageWriter : public FormatWriter {
 public:
  /// The bytes for a camera of a frame; a camera without an image is skipped.
  using Encode = std::function<std::string(const DatasetFrame&, std::size_t camera)>;

  /// `name` distinguishes it from other formats; `ending` is that of the files.
  ImageWriter(const std::filesystem::path& folder, const RecordingNotes& notes, std::string name,
              std::string ending, Encode encode);

  std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) override;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> cameras_;
  std::string name_;
  std::string ending_;
  Encode encode_;
};

/// Whether a camera gave an image at a frame.
bool delivered(const DatasetFrame& frame, std::size_t camera);

/// What is true of a camera's image of a frame; as far as it was asked for.
const RenderedImage& truth_of(const DatasetFrame& frame, std::size_t camera);

/// Makes a folder for each camera of the notes and returns their names. Throws Error.
std::vector<std::string> make_camera_folders(const std::filesystem::path& folder,
                                             const RecordingNotes& notes);

}  // namespace vinebench::harness
