// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Also compiled as C++17: no C++20 here.

#include <cstdint>
#include <filesystem>

namespace vinebench {

/// Whether a file, which may not exist yet, can grow by that many bytes: 0, or the error number
/// that writing them would end with (ENOSPC, EFBIG). For files that need an index in the end: a
/// part is written only if the index will fit too. What cannot be found out is no lack.
int lack_of_room(const std::filesystem::path& file, std::uint64_t more);

}  // namespace vinebench
