// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/pin_arithmetic.h"

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core/utility.hpp>

namespace vinebench {
namespace {

/// Another one where what llvm_symbols.cpp replaces changes.
constexpr const char* kShaderFolder = "vinebench-shaders-1";

/// Mesa's rule for its own folder.
std::filesystem::path user_cache() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') return cache;
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') return std::filesystem::path(home) / ".cache";
  return {};
}

std::atomic<bool> g_libraries_pinned = false;

}  // namespace

void pin_arithmetic() {
  cv::setUseOptimized(false);
  const char* chosen = std::getenv("MESA_SHADER_CACHE_DIR");
  const std::filesystem::path folder =
      chosen != nullptr && *chosen != '\0' ? std::filesystem::path(chosen) : user_cache();
  if (folder.empty()) {
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  } else if (folder.filename() != kShaderFolder) {  // of a parent process
    setenv("MESA_SHADER_CACHE_DIR", (folder / kShaderFolder).c_str(), 1);
  }
}

void declare_libraries_pinned() {
  g_libraries_pinned = true;
}

bool are_libraries_pinned() {
  return g_libraries_pinned;
}

}  // namespace vinebench
