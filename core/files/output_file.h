// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/files/descriptor.h"

namespace vinebench {

/// The end of the name of a file that is not complete yet.
inline constexpr const char* kPartialEnding = ".partial";

// Every file that the program writes is made by one of these. Neither opens what has the file's
// name already: a link in an output folder could lead anywhere.

/// Creates a file for writing, with the mode by umask; closed by exec. What has its name, also a
/// link, is removed first. Throws Error with the system's reason.
Descriptor create_file(const std::filesystem::path& file);

/// Writes all bytes; returns 0 or the error number.
int write_bytes(const Descriptor& descriptor, std::string_view bytes);

/// Gives a complete file a second name, by a hard link; what has that name is replaced. False, and
/// nothing done, where the system makes no link there: write the file again instead. Throws Error
/// with the system's reason where it makes one and does not let it have the name.
bool link_file(const std::filesystem::path& file, const std::filesystem::path& name);

/// A file that is written in parts to a temporary file beside it, of a random name, which gets the
/// file's name when complete. An unfinished one is removed. Throws Error with the system's reason.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  void write(std::string_view part);
  void finish();

 private:
  void flush();
  void check(int error) const;

  std::filesystem::path file_;
  std::filesystem::path partial_;
  Descriptor out_;
  std::string waiting_;
};

}  // namespace vinebench
