// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "harness/datasets/format/recorded_sequence.h"

namespace vinebench::harness {

/// Reads a COCO folder of ours strictly: ids are unique and known, images are there, every mask
/// decompresses to its image's size, and its area and box are the annotation's; in the first
/// panoptic images, that each segment has the area that is said of it and no pixel has none.
/// Throws Error for files that are no JSON.
std::vector<DatasetFault> check_coco(const std::filesystem::path& folder);

}  // namespace vinebench::harness
