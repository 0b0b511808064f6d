// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/datasets/files/append_file.h"

namespace vinebench::harness {

/// XXH3 of 128 bits as 32 digits, as `xxhsum -H128` prints it.
std::string xxh128(std::string_view bytes);

/// The same for a file, which may be larger than memory. Throws Error if it cannot be read.
std::string xxh128_of_file(const std::filesystem::path& file);

/// A file of a data set.
struct ListedFile {
  std::string name;  ///< relative to the data set, with '/'
  std::string hash;  ///< xxh128()
};

/// The list of a data set's files with their hashes, one a line, readable by `xxhsum -c`. It grows
/// with the data set, so that an interrupted one can be checked.
class FileManifest {
 public:
  static constexpr const char* kName = "files.xxh128";

  /// Starts the list of that folder.
  explicit FileManifest(const std::filesystem::path& folder);

  /// Adds files with these hashes.
  void add(const std::vector<ListedFile>& files);

  /// Adds every file of the folder that is neither listed yet nor in `without`.
  void add_rest(const std::vector<std::string>& without);

  std::int64_t files() const { return static_cast<std::int64_t>(names_.size()); }

 private:
  std::filesystem::path folder_;
  AppendFile list_;
  std::vector<std::string> names_;
};

/// Reads a list. Throws Error that names file and line; an incomplete last line is ignored.
std::vector<ListedFile> read_manifest(const std::filesystem::path& file);

/// All files below a folder, relative to it, by name.
std::vector<std::string> files_below(const std::filesystem::path& folder);

/// Their sizes together, of a file with several names once.
std::uint64_t bytes_below(const std::filesystem::path& folder);

}  // namespace vinebench::harness
