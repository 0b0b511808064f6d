// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/chunked_file.h"

#include <fmt/format.h>

#include "core/util/error.h"

namespace vinebench::harness {

ChunkedFile::ChunkedFile(const std::filesystem::path& file)
    : name_(file), file_(file, FileKind::kPart) {}

bool ChunkedFile::begins_with(std::string_view magic) const {
  std::string found(magic.size(), '\0');
  return file_.read_at(0, found.data(), found.size()) == magic.size() && found == magic;
}

std::string ChunkedFile::place_text(std::uint64_t byte) const {
  return fmt::format("{}: byte {}", name_.string(), byte);
}

std::string ChunkedFile::describe(const MessagePlace& place) const {
  if (!place.chunked) return fmt::format("byte {}", place.offset);
  return fmt::format("byte {} of the chunk at byte {}", place.offset, place.block);
}

std::string ChunkedFile::read_bytes(std::uint64_t at, std::uint64_t size) const {
  if (size > 2 * kMostMessageBytes) {
    fail("{}: expected at most {} bytes, found {}", place_text(at), 2 * kMostMessageBytes, size);
  }
  if (at > file_.size() || size > file_.size() - at) {
    fail("{}: expected {} more bytes, the file has {}", place_text(at), size, file_.size());
  }
  std::string bytes(size, '\0');
  if (file_.read_at(at, bytes.data(), size) < size) {
    fail("{}: expected {} more bytes", place_text(at), size);
  }
  return bytes;
}

std::shared_ptr<const std::string> ChunkedFile::chunk_at(std::uint64_t at) const {
  const std::lock_guard lock(mutex_);
  if (latest_ == nullptr || latest_at_ != at) {
    latest_.reset();
    latest_ = std::make_shared<const std::string>(unpack_chunk(at));
    latest_at_ = at;
  }
  return latest_;
}

std::string ChunkedFile::read(const MessagePlace& place) const {
  if (!place.chunked) return read_bytes(place.offset, place.size);
  const std::shared_ptr<const std::string> chunk = chunk_at(place.block);
  if (place.offset > chunk->size() || place.size > chunk->size() - place.offset) {
    fail("{}: expected {} bytes at byte {} of the chunk", place_text(place.block), place.size,
         place.offset);
  }
  return chunk->substr(place.offset, place.size);
}

}  // namespace vinebench::harness
