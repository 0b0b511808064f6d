// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "harness/datasets/format/recorded_sequence.h"

namespace vinebench::harness {

/// Checks a COCO folder of ours strictly: ids are unique and known, images exist, every mask
/// decompresses to its image's size, and its area and box are the annotation's; in the first
/// panoptic images, every segment has its listed area and every pixel a segment. Throws Error for
/// files that are not valid JSON.
std::vector<DatasetFault> check_coco(const std::filesystem::path& folder);

}  // namespace vinebench::harness
