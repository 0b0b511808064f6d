// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "core/files/output_folder.h"

namespace vinebench::harness {

/// Creates a folder of a recording and its parents. Throws Error as create_inner_folder() does.
std::filesystem::path make_folder(const std::filesystem::path& folder);

/// The recording's folder, made if it is missing, for this process alone. Throws Error as
/// FolderLock does.
[[nodiscard]] FolderLock lock_recording(const std::filesystem::path& folder);

/// Creates a new or empty folder and returns it. Throws Error if it cannot be created, is not
/// writable, or is not empty.
std::filesystem::path claim_folder(const std::filesystem::path& folder);

/// Removes what a process that ended abruptly has left of a file in the folder (OutputFile).
void remove_unfinished(const std::filesystem::path& folder);

/// Removes the content of a folder, not the folder; the entry of the name `last` after all others,
/// so that an interruption leaves it. Throws Error.
void clear_folder(const std::filesystem::path& folder, const std::string& last = "");

}  // namespace vinebench::harness
