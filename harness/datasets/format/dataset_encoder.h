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

/// Writes frames in several formats side by side, beside the loop that makes them: the files of a
/// frame on a few threads, then the formats' lists, frame after frame. Few frames wait, so that
/// memory is bounded; the loop waits where the disk does not keep up.
class DatasetEncoder {
 public:
  using Writers = std::vector<std::unique_ptr<FormatWriter>>;

  /// Files are listed in the manifest, where there is one, relative to `root`.
  DatasetEncoder(Writers writers, int threads, const std::filesystem::path& root = {},
                 FileManifest* manifest = nullptr);

  /// Rethrows what went wrong with an earlier frame; nothing is written after that one.
  void submit(DatasetFrame frame);

  /// Waits until all is written and finishes the formats; rethrows likewise.
  void finish();

  /// Made so far by the frames' tasks.
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
  std::map<std::string, double> seconds_;  ///< that a task of this key took last
  BackgroundWorker worker_;                // last: it must go first
};

/// The images of a frame in memory of their own: a source may use its own for the next frame.
DatasetFrame own_frame(const Sample& sample, std::int64_t number);

}  // namespace vinebench::harness
