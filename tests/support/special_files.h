// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "tests/support/test_folder.h"

namespace vinebench::test {

/// A pipe without a writer: opening it to read waits for ever.
inline std::filesystem::path make_pipe(const TestFolder& folder, const std::string& name) {
  EXPECT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
  return folder / name;
}

/// A link to a device without an end.
inline std::filesystem::path link_to_device(const TestFolder& folder, const std::string& name) {
  std::filesystem::create_symlink("/dev/zero", folder / name);
  return folder / name;
}

/// A link to itself.
inline std::filesystem::path make_loop(const TestFolder& folder, const std::string& name) {
  std::filesystem::create_symlink(name, folder / name);
  return folder / name;
}

}  // namespace vinebench::test
