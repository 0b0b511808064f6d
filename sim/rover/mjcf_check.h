// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace vinebench::sim {

/// Throws Error unless the MJCF model and the files that it names, as far as they exist, are
/// regular files of at most 1 GiB: MuJoCo opens them by their names, and would wait for a pipe for
/// ever.
void check_mjcf_files(const std::filesystem::path& mjcf);

}  // namespace vinebench::sim
