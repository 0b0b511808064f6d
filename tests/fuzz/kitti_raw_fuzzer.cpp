// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/open_recording.h"
#include "tests/fuzz/input_files.h"

using namespace vinebench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool written =
      fuzz::write_images({"image_00/data/0000000000.png", "image_00/data/0000000001.png",
                          "image_01/data/0000000000.png", "image_01/data/0000000001.png"},
                         {1242, 375});
  const std::vector<std::string> names{"calib_cam_to_cam.txt",    "calib_imu_to_velo.txt",
                                       "calib_velo_to_cam.txt",   "image_00/timestamps.txt",
                                       "image_01/timestamps.txt", "oxts/timestamps.txt",
                                       "oxts/data/0000000000.txt"};
  if (!written) return 0;
  return fuzz::fuzz_folder(data, size, names, [](const std::filesystem::path& folder) {
    harness::open_recording(folder);
  });
}
