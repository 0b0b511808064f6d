// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/output_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/util/error.h"

namespace vinebench {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_create(const fs::path& folder, const std::string& reason) {
  fail("{}: cannot be created: {}", folder.string(), reason);
}

void create_with_parents(const fs::path& folder) {
  std::error_code error;
  if (folder.empty()) return;
  fs::create_directories(folder, error);
  if (error) fail_to_create(folder, error.message());
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) {
  create_with_parents(folder);
  folder_ = Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder_.valid()) fail("{}: cannot be opened: {}", folder.string(), std::strerror(errno));
  if (::flock(folder_.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    fail("{}: another process is writing there; wait for it or choose another folder",
         folder.string());
  }
}

void create_inner_folder(const fs::path& folder) {
  create_with_parents(folder.parent_path());
  if (::mkdir(folder.c_str(), 0777) == 0) return;
  if (errno != EEXIST) fail_to_create(folder, std::strerror(errno));
  const fs::file_status status = fs::symlink_status(folder);
  if (fs::is_symlink(status)) {
    fail("{}: is a link; expected a folder, as links in an output folder are not followed",
         folder.string());
  }
  if (!fs::is_directory(status)) fail_to_create(folder, std::strerror(ENOTDIR));
}

TemporaryFolder::TemporaryFolder(fs::path parent) {
  std::error_code error;
  if (parent.empty()) parent = fs::temp_directory_path(error);
  if (error) fail("no folder for temporary files (TMPDIR): {}", error.message());
  std::string name = (parent / "vinebench-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) fail_to_create(name, std::strerror(errno));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace vinebench
