// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <system_error>

#include "core/files/output_file.h"
#include "core/util/error.h"

namespace vinebench {

std::string read_file(const std::filesystem::path& file, FileKind kind) {
  constexpr std::size_t kMore = std::size_t{1} << 16;
  InputFile in(file, kind);
  std::string content;
  try {
    // One byte more than there should be: its absence is the end of the file.
    for (std::size_t room = in.size() + 1;; room = content.size() + kMore) {
      const std::size_t before = content.size();
      content.resize(std::max(room, before + 1));
      const std::size_t filled = before + in.read(content.data() + before, content.size() - before);
      const bool whole = filled < content.size();
      content.resize(filled);
      if (whole) return content;
    }
  } catch (const std::bad_alloc&) {
    fail("{}: not enough memory for its {} bytes", file.string(), in.size());
  }
}

void write_file_atomically(const std::filesystem::path& file, std::string_view content) {
  OutputFile out(file);
  out.write(content);
  out.finish();
}

}  // namespace vinebench
