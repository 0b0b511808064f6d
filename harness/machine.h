// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/files/cache_folder.h"

namespace vinebench::harness {

/// What a simulation takes from the machine that it runs on and not from its scenario. Changes no
/// result.
struct Machine {
  std::string gl_platform;  ///< where a scenario leaves it open; automatic if empty
  CacheFolder plant_cache;
  std::filesystem::path plugin_host{};  ///< find_plugin_host(); set by programs
};

/// $VINEBENCH_GL, and $VINEBENCH_CACHE, else $XDG_CACHE_HOME/vinebench, else ~/.cache/vinebench,
/// else one of this user in the folder for temporary files. For programs: nothing else reads the
/// environment.
Machine machine_of_environment();

}  // namespace vinebench::harness
