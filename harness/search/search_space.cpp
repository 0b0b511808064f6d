// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/search/search_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/config/yaml.h"
#include "core/util/error.h"
#include "core/util/suggestion.h"

namespace vinebench::harness {
namespace {

/// A number as a person would write it: four digits.
std::string text_between(const std::vector<double>& values, double severity) {
  const double place = severity * static_cast<double>(values.size() - 1);
  const auto before = std::min(static_cast<std::size_t>(place), values.size() - 2);
  const double share = place - static_cast<double>(before);
  return fmt::format("{:.4g}", values[before] + share * (values[before + 1] - values[before]));
}

}  // namespace

SearchSpace load_search_space(const std::filesystem::path& file) {
  auto space = YamlDocument::load(file).read<SearchSpace>();
  std::set<std::string> names;
  std::set<std::string> keys;
  for (const Difficulty& difficulty : space.difficulties) {
    if (!names.insert(difficulty.name).second) {
      fail("{}: difficulties: '{}' is there twice", file.string(), difficulty.name);
    }
    for (const auto& [key, value] : values_at(difficulty, 1)) {
      if (!keys.insert(key).second) {
        fail("{}: difficulties: {} is changed by two of them", file.string(), key);
      }
    }
  }
  return space;
}

std::vector<Override> values_at(const Difficulty& difficulty, double severity) {
  std::vector<Override> overrides;
  for (const auto& [key, values] : difficulty.between) {
    overrides.emplace_back(key, text_between(values, severity));
  }
  for (const auto& [key, values] : difficulty.steps) {
    const double place = severity * static_cast<double>(values.size() - 1);
    overrides.emplace_back(key, values[static_cast<std::size_t>(std::lround(place))]);
  }
  return overrides;
}

std::vector<Override> overrides_at(const SearchSpace& space, const Severities& severities) {
  std::vector<Override> overrides;
  for (std::size_t i = 0; i < severities.size(); ++i) {
    if (severities[i] <= 0) continue;
    const auto more = values_at(space.difficulties.at(i), severities[i]);
    overrides.insert(overrides.end(), more.begin(), more.end());
  }
  return overrides;
}

std::string text_of(const SearchSpace& space, const Severities& severities) {
  std::string text;
  for (std::size_t i = 0; i < severities.size(); ++i) {
    if (severities[i] <= 0) continue;
    const Difficulty& difficulty = space.difficulties.at(i);
    std::string values;
    for (const auto& [key, value] : values_at(difficulty, severities[i])) {
      values += fmt::format("{}{}={}", values.empty() ? "" : " ", key, value);
    }
    text += fmt::format("{}{} {:.2g} ({})", text.empty() ? "" : ", ", difficulty.name,
                        severities[i], values);
  }
  return text.empty() ? "as it is" : text;
}

std::size_t difficulty_named(const SearchSpace& space, const std::string& name) {
  std::vector<std::string> names;
  for (const Difficulty& difficulty : space.difficulties) names.push_back(difficulty.name);
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    fail("difficulty '{}': expected one of the space's{}", name, did_you_mean(name, names));
  }
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace vinebench::harness
