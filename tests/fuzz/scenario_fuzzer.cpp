// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/scenario.h"
#include "tests/fuzz/input_files.h"

using namespace vinebench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::fuzz_file(data, size, "scenario.yaml", [](const std::filesystem::path& file) {
    harness::resolved_settings(harness::load_scenario(file));
  });
}
