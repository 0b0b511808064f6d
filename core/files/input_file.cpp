// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/util/error.h"

namespace vinebench {
namespace {

constexpr std::uintmax_t kMebibyte = std::uintmax_t{1} << 20;

std::string size_text(std::uintmax_t bytes) {
  const std::uintmax_t mebibytes = bytes / kMebibyte;
  return mebibytes < 1024 ? fmt::format("{} MiB", mebibytes)
                          : fmt::format("{} GiB", mebibytes / 1024);
}

/// What makes a file unreadable by its type; empty for a regular file.
std::string problem_of(const struct stat& status) {
  if (S_ISREG(status.st_mode)) return "";
  if (S_ISDIR(status.st_mode)) return "is a folder, not a file";
  return "expected a regular file, found a pipe or a device";
}

}  // namespace

std::uintmax_t size_limit(FileKind kind) {
  switch (kind) {
    case FileKind::kYaml:
      return 4 * kMebibyte;
    case FileKind::kTable:
    case FileKind::kImage:
      return 256 * kMebibyte;
    case FileKind::kJson:
    case FileKind::kMesh:
      return 1024 * kMebibyte;
    case FileKind::kMap:
    case FileKind::kOther:
      return 4096 * kMebibyte;
    case FileKind::kPart:
      return kMebibyte * kMebibyte;
  }
  fail("no kind of file: {}", static_cast<int>(kind));
}

InputFile::InputFile(std::filesystem::path file, FileKind kind)
    : file_(std::move(file)), limit_(size_limit(kind)) {
  // Opening a pipe would wait for its writer without O_NONBLOCK, which changes nothing for a file.
  descriptor_ = open(file_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
  if (descriptor_ < 0) fail("{}: cannot be read: {}", file_.string(), std::strerror(errno));
  struct stat status {};
  const bool known = fstat(descriptor_, &status) == 0;
  std::string problem = known ? problem_of(status) : std::strerror(errno);
  size_ = static_cast<std::uintmax_t>(status.st_size);
  if (problem.empty() && size_ > limit_) {
    problem = fmt::format("expected at most {}, found {} bytes", size_text(limit_), size_);
  }
  if (problem.empty()) return;
  close(descriptor_);
  fail("{}: {}", file_.string(), problem);
}

InputFile::~InputFile() {
  close(descriptor_);
}

std::size_t InputFile::read(char* to, std::size_t size) {
  std::size_t filled = 0;
  while (filled < size) {
    const ssize_t count = ::read(descriptor_, to + filled, size - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("{}: cannot be read: {}", file_.string(), std::strerror(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  taken_ += filled;
  if (taken_ > limit_) fail("{}: expected at most {}", file_.string(), size_text(limit_));
  return filled;
}

std::size_t InputFile::read_at(std::uintmax_t offset, char* to, std::size_t size) const {
  std::size_t filled = 0;
  while (filled < size) {
    const ssize_t count =
        pread(descriptor_, to + filled, size - filled, static_cast<off_t>(offset + filled));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("{}: cannot be read: {}", file_.string(), std::strerror(errno));
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  return filled;
}

InputStream::InputStream(const std::filesystem::path& file, FileKind kind)
    : std::istream(nullptr), buffer_(file, kind) {
  rdbuf(&buffer_);
  exceptions(std::ios::badbit);  // otherwise the stream would swallow the buffer's Error
}

InputStream::Buffer::int_type InputStream::Buffer::underflow() {
  const std::size_t count = file_.read(part_.data(), part_.size());
  setg(part_.data(), part_.data(), part_.data() + count);
  return count == 0 ? traits_type::eof() : traits_type::to_int_type(part_.front());
}

void check_input_file(const std::filesystem::path& file, FileKind kind) {
  const InputFile opened(file, kind);
}

bool is_present(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
}

}  // namespace vinebench
