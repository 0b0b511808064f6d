// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/files/image_size.h"
#include "harness/datasets/reading/recorded_images.h"
#include "tests/fuzz/input_files.h"

using namespace vinebench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  image_size(fuzz::text_of(data, size));
  return fuzz::fuzz_file(data, size, "image.png",
                         [](const std::filesystem::path& file) { harness::read_grey(file); });
}
