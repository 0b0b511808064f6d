// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace vinebench::test {

/// The folder beside the test programs where they keep generated plants for each other: to grow a
/// set takes seconds. The files' names hold all that plants depend on.
inline std::filesystem::path shared_plants() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "test-plants";
}

}  // namespace vinebench::test
