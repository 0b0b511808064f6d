// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/append_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/util/error.h"

namespace vinebench::harness {

AppendFile::AppendFile(std::filesystem::path file)
    : file_(std::move(file)), out_(file_, std::ios::binary | std::ios::trunc) {
  if (!out_) fail("{}: cannot be written: {}", file_.string(), std::strerror(errno));
}

void AppendFile::append(std::string_view part) {
  out_.write(part.data(), static_cast<std::streamsize>(part.size()));
  out_.flush();
  if (!out_) {
    const int reason = errno;
    std::error_code ignored;
    std::filesystem::resize_file(file_, size_, ignored);
    fail("{}: cannot be written: {}", file_.string(), std::strerror(reason));
  }
  size_ += part.size();
}

}  // namespace vinebench::harness
