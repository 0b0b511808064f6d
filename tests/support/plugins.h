// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace vinebench::test {

/// A file beside this program, such as a plug-in of tests/harness/systems.
inline std::filesystem::path beside_test(const char* name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

}  // namespace vinebench::test
