// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/util/worker_pool.h"
#include "harness/datasets/files/background_worker.h"
#include "harness/datasets/files/file_manifest.h"
#include "harness/datasets/format/format_writer.h"

namespace vinebench::harness {

/// Writes frames in several formats, concurrently with the loop that makes them: the files of a
/// frame on a few threads, then the formats' lists. Few frames are queued, so that memory is
/// bounded; the loop waits if the disk falls behind.
class DatasetEncoder {
 public:
  using Writers = std::vector<std::unique_ptr<FormatWriter>>;

  /// Files are listed in the manifest, if there is one, relative to `root`.
  DatasetEncoder(Writers writers, int threads, const std::filesystem::path& root = {},
                 FileManifest* manifest = nullptr);

  /// Rethrows an exception of an earlier frame; nothing is written after that one.
  void submit(DatasetFrame frame);

  /// Waits until everything is written and finishes the formats; rethrows likewise.
  void finish();

  /// Bytes written so far by the frames' tasks; a file of several names counts once.
  std::uint64_t bytes() const { return bytes_; }

 private:
  using TaskGroup = std::vector<FileTask>;  ///< of the same bytes

  void write(const std::shared_ptr<const DatasetFrame>& frame);
  std::vector<std::size_t> longest_first(const std::vector<TaskGroup>& groups) const;

  Writers writers_;
  WorkerPool pool_;
  std::filesystem::path root_;
  FileManifest* manifest_;
  std::atomic<std::uint64_t> bytes_{0};
  std::map<std::string, double> seconds_;  ///< of the last task with this key
  BackgroundWorker worker_;                // last member: it is destroyed first
};

/// Copies the images of a frame, because a source may reuse its memory.
DatasetFrame own_frame(const Sample& sample, std::int64_t number);

}  // namespace vinebench::harness
