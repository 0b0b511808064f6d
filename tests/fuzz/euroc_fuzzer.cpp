// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/open_recording.h"
#include "tests/fuzz/input_files.h"

using namespace vinebench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool written =
      fuzz::write_images({"mav0/cam0/data/0.png", "mav0/cam0/data/66666667.png",
                          "mav0/cam1/data/0.png", "mav0/cam1/data/66666667.png"},
                         {752, 480});
  const std::vector<std::string> names{"mav0/cam0/data.csv",
                                       "mav0/cam0/sensor.yaml",
                                       "mav0/cam1/data.csv",
                                       "mav0/cam1/sensor.yaml",
                                       "mav0/imu0/data.csv",
                                       "mav0/imu0/sensor.yaml",
                                       "mav0/state_groundtruth_estimate0/data.csv"};
  if (!written) return 0;
  return fuzz::fuzz_folder(data, size, names, [](const std::filesystem::path& folder) {
    harness::open_recording(folder);
  });
}
