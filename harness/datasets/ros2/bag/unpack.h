// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace vinebench::harness {

/// Bytes of a bag's chunk without compression, of which there must be `size`; `compression` is
/// the bag's word for it: "" or "none", "zstd", "lz4" (frames), "bz2". Throws Error for another,
/// for damaged data and for another size than that.
std::string unpack(std::string_view compression, std::string_view data, std::uint64_t size);

}  // namespace vinebench::harness
