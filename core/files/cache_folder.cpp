// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/cache_folder.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/files/descriptor.h"
#include "core/files/files.h"
#include "core/files/output_file.h"
#include "core/util/error.h"
#include "core/util/random.h"

namespace vinebench {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kOwn = 0700;
constexpr std::size_t kPart = std::size_t{1} << 16;  // bytes

std::string hash_name(const std::string& name) {
  return name + ".fnv1a";
}

/// The name is part of it, so that a file under another's name does not count.
std::string hash_line(const std::string& name, std::string_view content) {
  return fmt::format("{:016x}\n", fnv1a(content, fnv1a(name)));
}

/// Without a final '/', after which the system would follow a link.
fs::path plain_name(const fs::path& folder) {
  std::error_code error;
  const fs::path absolute = fs::absolute(folder, error).lexically_normal();
  if (error) fail("{}: {}", folder.string(), error.message());
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

/// Whether it stands where all users may write, as in /tmp, so that anyone may have made it.
bool in_public_place(const fs::path& name) {
  struct stat parent {};
  return ::stat(name.parent_path().c_str(), &parent) == 0 && (parent.st_mode & S_IWOTH) != 0;
}

void expect_own(const Descriptor& folder, const fs::path& name) {
  struct stat status {};
  if (::fstat(folder.number(), &status) != 0) fail("{}: {}", name.string(), std::strerror(errno));
  if (status.st_uid != ::geteuid()) {
    fail("{}: belongs to another user; expected a folder of this user", name.string());
  }
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    fail("{}: other users may write to it; expected a folder of this user alone", name.string());
  }
}

Descriptor open_folder(const fs::path& name) {
  const bool in_public = in_public_place(name);
  const int no_link = in_public ? O_NOFOLLOW : 0;
  Descriptor folder(::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | no_link));
  if (!folder.valid()) fail("{}: cannot be used: {}", name.string(), std::strerror(errno));
  if (in_public) expect_own(folder, name);
  return folder;
}

void create_folder(const fs::path& name) {
  std::error_code error;
  fs::create_directories(name.parent_path(), error);
  if (error) fail("{}: cannot be created: {}", name.string(), error.message());
  if (::mkdir(name.c_str(), kOwn) != 0 && errno != EEXIST) {
    fail("{}: cannot be created: {}", name.string(), std::strerror(errno));
  }
}

/// The folder's name after creating and checking it.
fs::path usable_folder(const CacheFolder& cache) {
  if (cache.folder.empty()) fail("there is no folder for them");
  fs::path name = plain_name(cache.folder);
  create_folder(name);
  open_folder(name);
  return name;
}

bool is_trusted(const Descriptor& file, const Descriptor& folder) {
  struct stat of_file {};
  struct stat of_folder {};
  if (::fstat(file.number(), &of_file) != 0 || ::fstat(folder.number(), &of_folder) != 0) {
    return false;
  }
  return S_ISREG(of_file.st_mode) && (of_file.st_uid == ::geteuid() || of_file.st_uid == 0 ||
                                      of_file.st_uid == of_folder.st_uid);
}

std::optional<std::string> read_trusted(const Descriptor& folder, const std::string& name) {
  // Opening a pipe would wait for its writer.
  const Descriptor file(
      ::openat(folder.number(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  if (!file.valid() || !is_trusted(file, folder)) return std::nullopt;
  std::string content;
  std::array<char, kPart> part{};
  for (;;) {
    const ssize_t count = ::read(file.number(), part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return std::nullopt;
    if (count == 0) return content;
    content.append(part.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

std::optional<std::string> read_cached(const CacheFolder& cache, const std::string& name) {
  if (cache.folder.empty()) return std::nullopt;
  try {
    const Descriptor folder = open_folder(plain_name(cache.folder));
    std::optional<std::string> content = read_trusted(folder, name);
    if (!content || read_trusted(folder, hash_name(name)) != hash_line(name, *content)) {
      return std::nullopt;
    }
    return content;
  } catch (const Error&) {  // whoever writes to the folder gets to know it
    return std::nullopt;
  }
}

void write_cached(const CacheFolder& cache, const std::string& name, std::string_view content) {
  const fs::path folder = usable_folder(cache);
  write_file_atomically(folder / name, content);
  write_file_atomically(folder / hash_name(name), hash_line(name, content));
}

std::string problem_of(const CacheFolder& cache) {
  try {
    OutputFile(usable_folder(cache) / "probe").write("x");
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace vinebench
