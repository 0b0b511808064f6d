// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "core/config/override.h"

namespace vinebench::harness {

/// One way in which a scenario is made harder, by its severity: from 0, the scenario as it is, to
/// 1. A key has two values or more, from mild to severe, at equal distances of the severity.
struct Difficulty {
  std::string name;
  std::map<std::string, std::vector<double>> between;     ///< numbers, also those between them
  std::map<std::string, std::vector<std::string>> steps;  ///< YAML values, the nearest one
  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("between", between);
    archive("steps", steps);
    archive.require(!name.empty(), "name", "expected a name");
    archive.require(!between.empty() || !steps.empty(), "between",
                    "expected between or steps, with the keys that change");
    for (const auto& [key, values] : between) {
      archive.require(values.size() >= 2, "between." + key, "expected two values or more");
    }
    for (const auto& [key, values] : steps) {
      archive.require(values.size() >= 2, "steps." + key, "expected two values or more");
    }
  }
};

/// The conditions among which a search looks.
struct SearchSpace {
  std::vector<Difficulty> difficulties;
  template <class Archive>
  void serialize(Archive& archive) {
    archive("difficulties", difficulties);
    archive.require(!difficulties.empty(), "difficulties", "expected at least one");
  }
};

/// One severity for each difficulty of a space.
using Severities = std::vector<double>;

/// Severities are multiples of this, so that conditions that hardly differ are run once.
inline constexpr double kSeverityStep = 1.0 / 64;

/// Throws Error that names file, line and key, also if two difficulties have the same name or key.
SearchSpace load_search_space(const std::filesystem::path& file);

/// What a scenario is given under these severities: nothing of those that are 0.
std::vector<Override> overrides_at(const SearchSpace& space, const Severities& severities);

/// The same of one difficulty alone, also at 0, where that is its mildest.
std::vector<Override> values_at(const Difficulty& difficulty, double severity);

/// "low sun 0.25 (world.sun.elevation_deg=38.8), ..."; "as it is" where all are 0.
std::string text_of(const SearchSpace& space, const Severities& severities);

/// The index of a difficulty. Throws Error, with the nearest name, if there is none.
std::size_t difficulty_named(const SearchSpace& space, const std::string& name);

}  // namespace vinebench::harness
