// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/dataset_folder.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <regex>
#include <system_error>
#include <vector>

#include "core/util/error.h"

namespace vinebench::harness {

std::filesystem::path make_folder(const std::filesystem::path& folder) {
  try {
    create_inner_folder(folder);
  } catch (const Error& error) {
    fail("recording {}", error.what());
  }
  return folder;
}

FolderLock lock_recording(const std::filesystem::path& folder) {
  try {
    return FolderLock(folder);
  } catch (const Error& error) {
    fail("recording {}", error.what());
  }
}

std::filesystem::path claim_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail("recording {}: cannot be created: {}", folder.string(), error.message());
  const bool empty = std::filesystem::is_empty(folder, error);
  if (error) fail("recording {}: cannot be read: {}", folder.string(), error.message());
  if (!empty) {
    fail("recording {}: is not empty; expected a new or an empty folder", folder.string());
  }
  if (access(folder.c_str(), W_OK) != 0) {
    fail("recording {}: cannot be written to: {}", folder.string(), std::strerror(errno));
  }
  return folder;
}

void remove_unfinished(const std::filesystem::path& folder) {
  static const std::regex unfinished(".*\\.[0-9a-f]{16}\\.partial");
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (std::regex_match(entry.path().filename().string(), unfinished)) {
      std::filesystem::remove(entry.path(), ignored);
    }
  }
}

void clear_folder(const std::filesystem::path& folder, const std::string& last) {
  std::error_code error;
  std::vector<std::filesystem::path> entries;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    entries.push_back(entry.path());
  }
  const auto not_last = [&](const std::filesystem::path& entry) {
    return entry.filename() != last;
  };
  // Not std::ranges: clang 14 does not compile its subranges with libstdc++ 12.
  std::stable_partition(entries.begin(), entries.end(), not_last);
  for (const std::filesystem::path& entry : entries) {
    if (!error) std::filesystem::remove_all(entry, error);
  }
  if (error) fail("recording {}: cannot be cleared: {}", folder.string(), error.message());
}

}  // namespace vinebench::harness
