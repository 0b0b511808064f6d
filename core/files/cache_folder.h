// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace vinebench {

/// A folder for files that can be made again, each beside a hash of its name and content. Several
/// processes may use it at once.
struct CacheFolder {
  CacheFolder() = default;
  /// Implicit: most users of a cache only name its folder.
  CacheFolder(std::filesystem::path name) : folder(std::move(name)) {}

  std::filesystem::path folder;  ///< nothing is kept if empty
  /// Receives why something is not kept; may be empty.
  std::function<void(const std::string&)> notice{};
};

/// A kept file's content. None if it is not there, does not match its hash, is a link, or belongs
/// neither to this user, nor to root, nor to the folder's owner.
std::optional<std::string> read_cached(const CacheFolder& cache, const std::string& name);

/// Keeps a file; creates the folder for this user alone if it is missing. Throws Error if it cannot
/// be written, or if it stands where all users may write and is a link, belongs to another user or
/// is writable for others.
void write_cached(const CacheFolder& cache, const std::string& name, std::string_view content);

/// Why write_cached() would fail, found by trying; empty if it would not.
std::string problem_of(const CacheFolder& cache);

}  // namespace vinebench
