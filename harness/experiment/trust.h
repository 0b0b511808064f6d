// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <vector>

#include "harness/experiment/scenario.h"

namespace vinebench::harness {

/// The files that a scenario's values name: models, meshes, cultivars, plug-ins, programs. Without
/// those that its text was put together from (base, world, rover).
std::set<std::filesystem::path> files_of(const ScenarioConfig& scenario);

/// What a scenario of unknown origin may use.
struct Untrusted {
  /// Beside the scenario's own folder, it may name files in these alone.
  std::vector<std::filesystem::path> data_folders;
};

/// Throws Error if the scenario, which was read from `file`, executes a program, loads code, or
/// names a file elsewhere, by links either.
void check_untrusted(const ScenarioConfig& scenario, const std::filesystem::path& file,
                     const Untrusted& untrusted);

}  // namespace vinebench::harness
