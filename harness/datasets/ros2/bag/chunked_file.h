// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>

#include "core/files/input_file.h"
#include "harness/datasets/ros2/bag/bag_file.h"

namespace vinebench::harness {

/// A file of a bag with messages in chunks, which may be compressed.
class ChunkedFile : public BagFile {
 public:
  std::string read(const MessagePlace& place) const override;
  std::string describe(const MessagePlace& place) const override;

 protected:
  explicit ChunkedFile(const std::filesystem::path& file);

  const std::filesystem::path& name() const { return name_; }
  std::uint64_t size() const { return file_.size(); }
  /// Whether the file begins with these bytes.
  bool begins_with(std::string_view magic) const;
  std::string place_text(std::uint64_t byte) const;
  std::string read_bytes(std::uint64_t at, std::uint64_t size) const;
  /// The records of the chunk at that byte; of the latest one unpacked once only.
  std::shared_ptr<const std::string> chunk_at(std::uint64_t at) const;

 private:
  virtual std::string unpack_chunk(std::uint64_t at) const = 0;

  std::filesystem::path name_;
  InputFile file_;
  mutable std::mutex mutex_;  ///< of the following
  mutable std::uint64_t latest_at_ = 0;
  mutable std::shared_ptr<const std::string> latest_;
};

}  // namespace vinebench::harness
