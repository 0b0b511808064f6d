// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <streambuf>

namespace vinebench {

/// What a file is read as. Each kind has a size limit, above which a file is refused before it is
/// read (docs/robustness.md).
enum class FileKind {
  kYaml,   ///< 4 MiB
  kTable,  ///< text with one row on each line, 256 MiB
  kJson,   ///< 1 GiB
  kImage,  ///< 256 MiB
  kMesh,   ///< 1 GiB
  kMap,    ///< 4 GiB
  kOther,  ///< read as a whole, 4 GiB
  kPart,   ///< of a data set, read part by part, 1 TiB
};

/// Bytes.
std::uintmax_t size_limit(FileKind kind);

/// A file that is open for reading. Only regular files (or links to them) can be opened: reading a
/// pipe may wait for ever, reading a device may never end.
class InputFile {
 public:
  /// Throws Error with the reason: missing, a folder, a pipe or a device, too large.
  InputFile(std::filesystem::path file, FileKind kind);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Fills `to`; returns fewer bytes than `size` only at the end of the file. Throws Error if
  /// reading fails or the file has grown beyond the limit.
  std::size_t read(char* to, std::size_t size);

  /// The same from a byte of the file on; on any thread, concurrently.
  std::size_t read_at(std::uintmax_t offset, char* to, std::size_t size) const;

  /// When it was opened, bytes.
  std::uintmax_t size() const { return size_; }

 private:
  std::filesystem::path file_;
  std::uintmax_t limit_;
  std::uintmax_t size_ = 0;
  std::uintmax_t taken_ = 0;
  int descriptor_ = -1;
};

/// An InputFile as a stream, for files that need not fit into memory. Throws Error, also while it
/// is read.
class InputStream : public std::istream {
 public:
  InputStream(const std::filesystem::path& file, FileKind kind);

 private:
  class Buffer : public std::streambuf {
   public:
    Buffer(const std::filesystem::path& file, FileKind kind) : file_(file, kind) {}

   protected:
    int_type underflow() override;

   private:
    InputFile file_;
    std::array<char, 1 << 16> part_;
  };

  Buffer buffer_;
};

/// Throws Error unless the file can be opened as an InputFile: for libraries that read files by
/// their names.
void check_input_file(const std::filesystem::path& file, FileKind kind);

/// Whether the name is taken, be it by a pipe or a link that leads nowhere: a file that may be
/// absent but is not is then opened, and its fault reported.
bool is_present(const std::filesystem::path& file);

}  // namespace vinebench
