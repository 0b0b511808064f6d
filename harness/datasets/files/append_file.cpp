// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/files/append_file.h"

#include <unistd.h>

#include <cstring>
#include <tuple>

#include "core/files/output_file.h"
#include "core/util/error.h"

namespace vinebench::harness {

AppendFile::AppendFile(std::filesystem::path file)
    : file_(std::move(file)), out_(create_file(file_)) {}

void AppendFile::append(std::string_view part) {
  if (const int reason = write_bytes(out_, part); reason != 0) {
    std::ignore = ftruncate(out_.number(), static_cast<off_t>(size_));
    fail("{}: cannot be written: {}", file_.string(), std::strerror(reason));
  }
  size_ += part.size();
}

}  // namespace vinebench::harness
