// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "core/files/descriptor.h"

namespace vinebench::harness {

/// A text file that grows by complete parts: each part is written at once, and a part that does not
/// fit on the disk is removed again. What had its name is replaced. Throws Error with the system's
/// reason.
class AppendFile {
 public:
  explicit AppendFile(std::filesystem::path file);
  void append(std::string_view part);

 private:
  std::filesystem::path file_;
  Descriptor out_;
  std::uintmax_t size_ = 0;
};

}  // namespace vinebench::harness
