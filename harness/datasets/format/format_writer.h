// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/truth/frame_source.h"
#include "harness/datasets/files/dataset_folder.h"
#include "harness/datasets/format/recording_notes.h"

namespace vinebench::harness {

/// One frame of a recording. Cameras are those of the data set, in its order.
struct DatasetFrame {
  std::int64_t number = 0;  ///< in the data set, from 0 on without gaps
  Frame frame;              ///< sensor data; the images are copies
  Truth truth;
};

/// A file of a frame in a format, such as an image.
struct FileTask {
  std::string key;  ///< tasks of one frame that have the same key have the same bytes
  std::filesystem::path file;
  std::function<std::string()> bytes;  ///< called on any thread, concurrently
  /// If set, it takes the bytes instead of a file; called likewise.
  std::function<void(const std::string&)> take{};
};

/// Writes a run in one format into its own folder. Everything except a FileTask's functions is
/// called on one thread, frame after frame. Throws Error.
class FormatWriter {
 public:
  virtual ~FormatWriter() = default;
  /// The files of a frame; may use earlier frames.
  virtual std::vector<FileTask> files(const std::shared_ptr<const DatasetFrame>& frame) = 0;
  /// The frame's files are complete: the lists may name them.
  virtual void commit(const DatasetFrame&) {}
  /// Called after the last frame.
  virtual void finish() {}
};

/// "000012.png" for number 12 and "png".
std::string numbered(std::int64_t number, const std::string& ending);

/// A camera's image as PNG: grey as the SLAM core uses it, or in colour. Shared by all formats.
FileTask camera_image(const std::shared_ptr<const DatasetFrame>& frame, std::size_t camera,
                      bool colour, std::filesystem::path file);

}  // namespace vinebench::harness
