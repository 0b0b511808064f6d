// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "harness/datasets/labels/label_table.h"

namespace vinebench::harness {

// COCO's two files, instances.json and panoptic.json. They may be larger than memory: every item
// of their lists has a line of its own, and lines are copied.

/// Makes both of a folder's images.jsonl, annotations.jsonl and panoptic.jsonl. `categories` are
/// those of instances.json, all things where empty. Throws Error.
void write_coco_from_lists(const std::filesystem::path& folder,
                           const std::set<Category>& categories);

/// Makes both, in `folder`, of those in these folders below it, the images' names relative to
/// `folder` (to the folder `panoptic` of each sequence for panoptic images likewise).
void merge_coco(const std::filesystem::path& folder, const std::vector<std::string>& parts,
                const std::set<Category>& categories);

}  // namespace vinebench::harness
