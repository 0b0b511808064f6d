// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/files/descriptor.h"

namespace vinebench {

/// A folder for results that this process alone writes as long as the object lives. The system ends
/// the lock with the process, however that ends; file systems without locks are not guarded.
class FolderLock {
 public:
  /// Creates the folder and its parents if they are missing. Throws Error if it cannot be created
  /// or another process has it.
  explicit FolderLock(const std::filesystem::path& folder);

 private:
  Descriptor folder_;
};

/// Creates a folder inside of an output folder unless it exists, and its parents. Throws Error for
/// a link in its place, which could lead anywhere, and with the system's reason.
void create_inner_folder(const std::filesystem::path& folder);

/// An empty folder of a random name, for this user alone, removed with the object.
class TemporaryFolder {
 public:
  /// In that folder; in the one for temporary files if empty. Throws Error.
  explicit TemporaryFolder(std::filesystem::path parent = {});
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace vinebench
