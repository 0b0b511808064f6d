// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace vinebench::harness {

/// Creates a folder and its parents. Throws Error with the system's reason.
std::filesystem::path make_folder(const std::filesystem::path& folder);

/// Creates a new or empty folder and returns it. Throws Error if it cannot be created, is not
/// writable, or is not empty.
std::filesystem::path claim_folder(const std::filesystem::path& folder);

/// Removes the content of a folder, not the folder; the entry of the name `last` after all others,
/// so that an interruption leaves it. Throws Error.
void clear_folder(const std::filesystem::path& folder, const std::string& last = "");

}  // namespace vinebench::harness
