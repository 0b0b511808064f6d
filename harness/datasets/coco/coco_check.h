// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "harness/datasets/dataset_check.h"

namespace vinebench {

/// Reads a COCO folder of ours strictly: ids are unique and known, pictures are there, every mask
/// decompresses to its picture's size, and its area and box are the annotation's; in the first
/// panoptic pictures, that each segment has the area that is said of it and no pixel has none.
/// Throws Error for files that are no JSON.
std::vector<DatasetFault> check_coco(const std::filesystem::path& folder);

}  // namespace vinebench
