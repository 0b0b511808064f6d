// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace vinebench::harness {

inline constexpr double kKittiRate = 10;  ///< Hz, of KITTI's cameras

/// Files of a folder by the number that is their name, with one of these endings (".txt"). Throws
/// Error for a folder that cannot be read.
std::map<std::int64_t, std::filesystem::path> numbered_files(const std::filesystem::path& folder,
                                                             const std::vector<std::string>& kinds);

/// Images by the number in their name. Throws Error if there is none.
std::map<std::int64_t, std::filesystem::path> images_in(const std::filesystem::path& folder);

}  // namespace vinebench::harness
