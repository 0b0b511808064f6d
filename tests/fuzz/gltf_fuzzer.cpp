// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/asset_file.h"
#include "tests/fuzz/input_files.h"

using namespace vinebench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::fuzz_file(data, size, "plant.glb",
                         [](const std::filesystem::path& file) { sim::load_asset(file); });
}
