// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/datasets/format/recorded_sequence.h"

namespace vinebench::harness {

struct DatasetReport {
  std::vector<DatasetFault> faults;
  std::vector<std::string> notes;  ///< remarks that are not faults, such as an interruption
  std::string interrupted;         ///< what there is of it, "3 of 15 frames"; empty if complete
  std::int64_t sequences = 0;
  std::int64_t frames = 0;
  std::int64_t files = 0;         ///< with compared hashes
  std::int64_t label_images = 0;  ///< compared with depth and calibration
};

/// Checks a data set of `vinebench record`: that every listed file exists with its hash and there
/// are no others, that each format's check holds, and at some frames that of its label images. Of
/// an interrupted one, what there is, whenever it was interrupted. Throws Error for a folder that
/// is no such data set.
DatasetReport check_dataset(const std::filesystem::path& folder);

}  // namespace vinebench::harness
