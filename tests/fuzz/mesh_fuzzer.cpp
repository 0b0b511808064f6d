// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/asset_file.h"
#include "tests/fuzz/input_files.h"

using namespace vinebench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The first byte chooses the format.
  if (size == 0) return 0;
  constexpr const char* kNames[] = {"mesh.obj", "mesh.stl", "mesh.dae", "mesh.gltf"};
  return fuzz::fuzz_file(data + 1, size - 1, kNames[data[0] % 4],
                         [](const std::filesystem::path& file) { sim::load_asset(file); });
}
