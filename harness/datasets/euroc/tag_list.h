// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/slam_system.h"

namespace vinebench::harness {

/// The registered tags of a recording: `tags`, a list of family, id, size (m), position (m) and
/// rotation (qx qy qz qw) in the world. Reading restores the same bits.
std::string format_tags(const std::vector<RegisteredTag>& tags);

/// Throws Error that names file, line and key.
std::vector<RegisteredTag> read_tags(const std::filesystem::path& file);

}  // namespace vinebench::harness
