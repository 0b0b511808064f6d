// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vinebench::harness {

/// One frame of Zstandard (RFC 8878), level 1; the same bytes of the same data and library.
std::string zstd_compress(std::string_view data);

/// The data of frames that have `size` bytes without compression. Throws Error if they have not,
/// and if they are damaged.
std::string zstd_decompress(std::string_view frames, std::uint64_t size);

}  // namespace vinebench::harness
