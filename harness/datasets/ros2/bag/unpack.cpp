// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/bag/unpack.h"

#include <bzlib.h>
#include <lz4frame.h>

#include <limits>
#include <memory>

#include "core/util/error.h"
#include "harness/datasets/ros2/mcap/zstd.h"

namespace vinebench::harness {
namespace {

void expect_size(std::uint64_t found, std::uint64_t size) {
  if (found == size) return;
  fail("expected {} bytes without compression, found {}", size, found);
}

/// One frame or several, one after the other.
std::string lz4_decompress(std::string_view frames, std::uint64_t size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) {
    fail("lz4: no memory");
  }
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> freed(
      context, LZ4F_freeDecompressionContext);
  std::string data(size, '\0');
  std::size_t written = 0;
  while (!frames.empty()) {
    std::size_t room = data.size() - written, taken = frames.size();
    const std::size_t state =
        LZ4F_decompress(context, data.data() + written, &room, frames.data(), &taken, nullptr);
    if (LZ4F_isError(state)) fail("lz4: {}", LZ4F_getErrorName(state));
    written += room;
    frames.remove_prefix(taken);
    if (room == 0 && taken == 0)
      fail("lz4: expected {} bytes without compression, found more", size);
  }
  expect_size(written, size);
  return data;
}

std::string bz2_decompress(std::string_view stream, std::uint64_t size) {
  if (size > std::numeric_limits<unsigned>::max() ||
      stream.size() > std::numeric_limits<unsigned>::max()) {
    fail("bz2: expected less than 4 GiB");
  }
  std::string data(size, '\0');
  auto found = static_cast<unsigned>(size);
  // The library does not write to its input, but does not say so.
  const int state =
      BZ2_bzBuffToBuffDecompress(data.data(), &found, const_cast<char*>(stream.data()),
                                 static_cast<unsigned>(stream.size()), 0, 0);
  if (state == BZ_OUTBUFF_FULL) {
    fail("bz2: expected {} bytes without compression, found more", size);
  }
  if (state != BZ_OK) fail("bz2: the data are damaged (error {})", state);
  expect_size(found, size);
  return data;
}

}  // namespace

std::string unpack(std::string_view compression, std::string_view data, std::uint64_t size) {
  if (compression == "zstd") return zstd_decompress(data, size);
  if (compression == "lz4") return lz4_decompress(data, size);
  if (compression == "bz2") return bz2_decompress(data, size);
  if (!compression.empty() && compression != "none") {
    fail("expected no compression, zstd, lz4 or bz2, found '{}'", compression);
  }
  expect_size(data.size(), size);
  return std::string(data);
}

}  // namespace vinebench::harness
