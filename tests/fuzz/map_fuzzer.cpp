// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "slam/map/map_file.h"
#include "tests/fuzz/input_files.h"
#include "tests/support/synthetic_aisle.h"

using namespace vinebench;

namespace {

/// CRC-64/XZ, bit by bit.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t crc = ~0ULL;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xc96c5795d7870f42ULL : 0);
  }
  return ~crc;
}

void append(std::string& file, std::uint64_t value, std::size_t bytes) {
  file.append(reinterpret_cast<const char*>(&value), bytes);
}

/// The content of an input as a map file of the right length and checksum, which no mutation would
/// hit; its first byte is the version.
std::string whole_file(std::string_view input) {
  std::string file("vinemap\0", 8);
  append(file, static_cast<std::uint8_t>(input[0]), 4);
  append(file, input.size() - 1, 8);
  file += input.substr(1);
  append(file, checksum(file), 8);
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const slam::EstimatorRig rig(test::SyntheticAisle(0, 1, 10).rig, slam::OrbConfig{});
  if (size == 0) return 0;
  const std::string file = whole_file(fuzz::text_of(data, size));
  return fuzz::expect_value_or_error([&] { slam::parse_map(file, rig, "input"); });
}
