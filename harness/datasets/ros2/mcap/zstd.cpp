// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/ros2/mcap/zstd.h"

#include <zstd.h>

#include "core/util/error.h"

namespace vinebench::harness {
namespace {

// Images with noise hardly get smaller with a higher one.
constexpr int kLevel = 1;

}  // namespace

std::string zstd_compress(std::string_view data) {
  std::string frame(ZSTD_compressBound(data.size()), '\0');
  const std::size_t size =
      ZSTD_compress(frame.data(), frame.size(), data.data(), data.size(), kLevel);
  if (ZSTD_isError(size)) fail("zstd: {}", ZSTD_getErrorName(size));
  frame.resize(size);
  return frame;
}

std::string zstd_decompress(std::string_view frames, std::uint64_t size) {
  std::string data(size, '\0');
  const std::size_t found = ZSTD_decompress(data.data(), data.size(), frames.data(), frames.size());
  if (ZSTD_isError(found)) fail("zstd: {}", ZSTD_getErrorName(found));
  if (found != size) fail("zstd: expected {} bytes without compression, found {}", size, found);
  return data;
}

}  // namespace vinebench::harness
