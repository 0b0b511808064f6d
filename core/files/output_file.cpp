// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <random>

#include "core/util/error.h"

namespace vinebench {
namespace {

constexpr mode_t kMode = 0666;  // less the umask
constexpr int kAttempts = 100;
constexpr std::size_t kTogether = std::size_t{1} << 16;  // bytes that wait for one call

int open_new(const std::filesystem::path& file) {
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kMode);
}

[[noreturn]] void fail_to_write(const std::filesystem::path& file, int error) {
  fail("{}: cannot be written: {}", file.string(), std::strerror(error));
}

/// Not to be foreseen, so that no other process makes the same or has made a link of that name.
std::filesystem::path temporary_name(const std::filesystem::path& file) {
  std::random_device random;
  std::filesystem::path name = file;
  name += fmt::format(".{:08x}{:08x}{}", random(), random(), kPartialEnding);
  return name;
}

}  // namespace

Descriptor create_file(const std::filesystem::path& file) {
  int error = EEXIST;
  for (int i = 0; i < kAttempts && error == EEXIST; ++i) {
    if (::unlink(file.c_str()) != 0 && errno != ENOENT) fail_to_write(file, errno);
    Descriptor out(open_new(file));
    if (out.valid()) return out;
    error = errno;
  }
  fail_to_write(file, error);
}

int write_bytes(const Descriptor& descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor.number(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

bool link_file(const std::filesystem::path& file, const std::filesystem::path& name) {
  const std::filesystem::path partial = temporary_name(name);
  if (::link(file.c_str(), partial.c_str()) != 0) return false;
  const int error = std::rename(partial.c_str(), name.c_str()) == 0 ? 0 : errno;
  ::unlink(partial.c_str());  // rename() leaves both names where they are of one file already
  if (error != 0) fail_to_write(name, error);
  return true;
}

OutputFile::OutputFile(std::filesystem::path file) : file_(std::move(file)) {
  int error = EEXIST;
  for (int i = 0; i < kAttempts && error == EEXIST; ++i) {
    partial_ = temporary_name(file_);
    out_ = Descriptor(open_new(partial_));
    error = out_.valid() ? 0 : errno;
  }
  if (error != 0) fail_to_write(file_, error);
}

OutputFile::~OutputFile() {
  if (!partial_.empty()) ::unlink(partial_.c_str());
}

void OutputFile::write(std::string_view part) {
  if (waiting_.size() + part.size() > kTogether) flush();
  if (part.size() > kTogether) {
    check(write_bytes(out_, part));
  } else {
    waiting_ += part;
  }
}

void OutputFile::finish() {
  flush();
  check(out_.close() == 0 ? 0 : errno);
  check(std::rename(partial_.c_str(), file_.c_str()) == 0 ? 0 : errno);
  partial_.clear();
}

void OutputFile::flush() {
  check(write_bytes(out_, waiting_));
  waiting_.clear();
}

void OutputFile::check(int error) const {
  if (error != 0) fail_to_write(file_, error);
}

}  // namespace vinebench
