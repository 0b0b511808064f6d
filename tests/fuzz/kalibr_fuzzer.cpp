// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/reading/recording.h"
#include "tests/fuzz/input_files.h"

using namespace vinebench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::fuzz_file(data, size, "camchain.yaml", [](const std::filesystem::path& file) {
    harness::Recording recording;
    harness::set_rig(file, 5, recording);
  });
}
