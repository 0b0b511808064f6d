// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/open_recording.h"
#include "tests/fuzz/input_files.h"

using namespace vinebench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool written =
      fuzz::write_images({"image_0/000000.png", "image_0/000001.png", "image_0/000002.png",
                          "image_1/000000.png", "image_1/000001.png", "image_1/000002.png"},
                         {1226, 370});
  const std::vector<std::string> names{"calib.txt", "times.txt", "poses.txt"};
  if (!written) return 0;
  return fuzz::fuzz_folder(data, size, names, [](const std::filesystem::path& folder) {
    harness::RecordingOptions options;
    if (std::filesystem::exists(folder / "poses.txt")) options.groundtruth = folder / "poses.txt";
    harness::open_recording(folder, options);
  });
}
