// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace vinebench::harness {

/// Makes a folder and those above it. Throws Error with the system's reason.
std::filesystem::path make_folder(const std::filesystem::path& folder);

/// Makes a folder that is ours alone to fill, and returns it. Throws Error for one that cannot be
/// made, cannot be written to, or has something in it.
std::filesystem::path claim_folder(const std::filesystem::path& folder);

/// Removes what is in a folder, and leaves the folder. Throws Error.
void clear_folder(const std::filesystem::path& folder);

}  // namespace vinebench::harness
