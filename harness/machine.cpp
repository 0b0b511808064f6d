// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/machine.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace vinebench::harness {
namespace {

/// nullptr where the variable is not set, or empty.
const char* non_empty(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

std::filesystem::path plant_cache() {
  if (const char* folder = non_empty("VINEBENCH_CACHE")) return folder;
  if (const char* folder = non_empty("XDG_CACHE_HOME")) {
    return std::filesystem::path(folder) / "vinebench";
  }
  if (const char* home = non_empty("HOME")) {
    return std::filesystem::path(home) / ".cache" / "vinebench";
  }
  std::error_code none;
  const std::filesystem::path temporary = std::filesystem::temp_directory_path(none);
  if (none) return {};
  return temporary / fmt::format("vinebench-cache-{}", geteuid());
}

}  // namespace

Machine machine_of_environment() {
  const char* platform = non_empty("VINEBENCH_GL");
  return {platform == nullptr ? "" : platform, plant_cache()};
}

}  // namespace vinebench::harness
