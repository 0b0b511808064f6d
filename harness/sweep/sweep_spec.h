// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/config/override.h"

namespace vinebench::harness {

/// What a sweep varies: every scenario with every system at every point of the grid, over all seeds
/// and repeats.
struct SweepSpec {
  std::vector<std::string> scenarios;      ///< names, or files relative to this one
  std::string seeds;                       ///< "1..100"; each scenario's own if empty
  int repeats = 1;                         ///< of each seed
  std::map<std::string, std::string> set;  ///< keys of all scenarios, as --set
  std::map<std::string, std::map<std::string, std::string>> systems;  ///< name: keys, as set
  std::map<std::string, std::vector<std::string>> grid;               ///< key: its values
  template <class Archive>
  void serialize(Archive& archive) {
    archive("scenarios", scenarios);
    archive("seeds", seeds);
    archive("repeats", repeats, {1, 1000});
    archive("set", set);
    archive("systems", systems);
    archive("grid", grid);
    archive.require(!scenarios.empty(), "scenarios", "expected at least one scenario");
    for (const auto& [key, values] : grid) {
      archive.require(!values.empty(), "grid." + key, "expected at least one value");
    }
    for (const auto& [name, keys] : systems) {
      const bool ok = !name.empty() && !name.starts_with('.') && name.find('/') == name.npos;
      archive.require(ok, "systems." + name,
                      "expected a name that begins with no '.' and has no '/'");
    }
  }
};

/// Settings that the seeds of a sweep share.
struct SweepCell {
  std::string scenario;                        ///< as of the specification
  std::string system;                          ///< empty where it names none
  std::map<std::string, std::string> point{};  ///< key: its value, of the grid
  std::vector<Override> overrides{};           ///< all of them, in the order in which they apply

  /// The system and the point, in a table: "fused, sun.elevation_deg=10"; empty without any.
  std::string label() const;

  /// Where its results go, before the scenario's name: "fused/sun.elevation_deg=10".
  std::filesystem::path folder() const;

  bool operator==(const SweepCell&) const = default;
};

/// Throws Error that names file, line and key.
SweepSpec load_sweep_spec(const std::filesystem::path& file);

/// All settings: by scenario, then by system, then by the grid's keys, the last of which changes
/// first. Throws Error if two have the same folder.
std::vector<SweepCell> cells_of(const SweepSpec& spec);

}  // namespace vinebench::harness
