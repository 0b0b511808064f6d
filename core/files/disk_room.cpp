// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/disk_room.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace vinebench {

int lack_of_room(const std::filesystem::path& file, std::uint64_t more) {
  std::error_code unknown;
  const std::filesystem::space_info space = std::filesystem::space(file.parent_path(), unknown);
  const std::uint64_t free = geteuid() == 0 ? space.free : space.available;
  rlimit limit{};
  const bool limited = getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  std::error_code none;
  const std::uint64_t size = std::filesystem::file_size(file, none);
  if (limited && (none ? 0 : size) + more > limit.rlim_cur) return EFBIG;
  return !unknown && free < more ? ENOSPC : 0;
}

}  // namespace vinebench
