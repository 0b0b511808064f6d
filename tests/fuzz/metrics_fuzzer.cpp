// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/report/stored_run.h"
#include "tests/fuzz/input_files.h"

using namespace vinebench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::fuzz_file(data, size, "metrics.json",
                         [](const std::filesystem::path& file) { harness::read_stored_run(file); });
}
