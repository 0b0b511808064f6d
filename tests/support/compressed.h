// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bzlib.h>
#include <lz4frame.h>

#include <string>

namespace vinebench::test {

inline std::string lz4_frame(const std::string& data) {
  std::string frame(LZ4F_compressFrameBound(data.size(), nullptr), '\0');
  frame.resize(LZ4F_compressFrame(frame.data(), frame.size(), data.data(), data.size(), nullptr));
  return frame;
}

inline std::string bz2_stream(std::string data) {
  // The library's bound: a hundredth and 600 bytes more.
  std::string stream(data.size() + data.size() / 100 + 600, '\0');
  auto size = static_cast<unsigned>(stream.size());
  BZ2_bzBuffToBuffCompress(stream.data(), &size, data.data(), static_cast<unsigned>(data.size()), 9,
                           0, 0);
  stream.resize(size);
  return stream;
}

}  // namespace vinebench::test
