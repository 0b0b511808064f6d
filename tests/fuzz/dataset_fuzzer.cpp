// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/datasets/dataset_check.h"
#include "tests/fuzz/input_files.h"

using namespace vinebench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::string> names{
      "dataset.yaml", "files.xxh128",        "scenario.resolved.yaml", "calibration.yaml",
      "frames.csv",   "coco/instances.json", "coco/panoptic.json"};
  return fuzz::fuzz_folder(data, size, names, [](const std::filesystem::path& folder) {
    harness::check_dataset(folder);
  });
}
