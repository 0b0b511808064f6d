// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "harness/datasets/labels/label_table.h"

namespace vinebench::harness {

/// Folder of the images, which `file_name` is relative to, as COCO's readers expect it.
inline constexpr const char* kCocoImages = "images";

// COCO's two files, instances.json and panoptic.json. They may be larger than memory: every item of
// their lists is one line, and lines are copied.

/// Makes both from a folder's images.jsonl, annotations.jsonl and panoptic.jsonl. `categories` are
/// those of instances.json, all things if empty. Throws Error.
void write_coco_from_lists(const std::filesystem::path& folder,
                           const std::set<Category>& categories);

/// Makes both in `folder` from those of these folders below it, with image names relative to
/// `folder` (for panoptic images, to the folder `panoptic` of each sequence).
void merge_coco(const std::filesystem::path& folder, const std::vector<std::string>& parts,
                const std::set<Category>& categories);

}  // namespace vinebench::harness
