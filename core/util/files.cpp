// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/files.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "core/util/error.h"

namespace vinebench {

std::string read_file(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    fail("{}: is a folder, not a file", file.string());
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("{}: cannot be read: {}", file.string(), std::strerror(errno));
  std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad()) fail("{}: cannot be read: {}", file.string(), std::strerror(errno));
  return content;
}

void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  std::filesystem::path partial = file;
  partial += kPartialEnding;
  std::ofstream out(partial, std::ios::binary | std::ios::trunc);
  if (!out) fail("{}: cannot be written: {}", file.string(), std::strerror(errno));
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  std::error_code error;
  if (!out) {
    const int reason = errno;
    std::filesystem::remove(partial, error);
    fail("{}: cannot be written: {}", file.string(), std::strerror(reason));
  }
  std::filesystem::rename(partial, file, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    fail("{}: cannot be written: {}", file.string(), error.message());
  }
}

}  // namespace vinebench
