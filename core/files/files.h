// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/files/input_file.h"

namespace vinebench {

/// The content of a regular file. Throws Error if it cannot be read, is something else or exceeds
/// the size limit of its kind.
std::string read_file(const std::filesystem::path& file, FileKind kind = FileKind::kOther);

/// Writes to a temporary file and renames it when complete, so that an interrupted run leaves no
/// incomplete file. Throws Error with the system's reason (permission, disk full).
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

}  // namespace vinebench
