// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/sweep/sweep_spec.h"

#include <fmt/format.h>

#include <cctype>
#include <set>
#include <string_view>

#include "core/config/yaml.h"
#include "core/util/error.h"
#include "harness/run/run_hash.h"
#include "harness/sets/seed_list.h"

namespace vinebench::harness {
namespace {

/// A file system's names have 255 bytes at most, and a reader's patience less.
constexpr std::size_t kLongestName = 100;

/// "sun.elevation_deg" of "world.sun.elevation_deg".
std::string short_key(const std::string& key) {
  const std::size_t last = key.rfind('.');
  if (last == std::string::npos) return key;
  const std::size_t before = key.rfind('.', last - 1);
  return before == std::string::npos ? key : key.substr(before + 1);
}

std::string point_text(const std::map<std::string, std::string>& point, const char* separator) {
  std::string text;
  for (const auto& [key, value] : point) {
    text += fmt::format("{}{}={}", text.empty() ? "" : separator, short_key(key), value);
  }
  return text;
}

/// A name of a folder that holds the text as far as file systems, shells and reports take it.
std::string folder_name(const std::string& text) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view(".,=_+-").find(c) != std::string_view::npos;
  };
  std::string name = text;
  for (char& c : name) {
    if (!is_plain(static_cast<unsigned char>(c))) c = '_';
  }
  if (name == text && name.size() <= kLongestName) return name;
  RunHash hash;
  hash.add(text);
  return name.substr(0, kLongestName) + "-" + hash.digits().substr(0, 8);
}

}  // namespace

std::string SweepCell::label() const {
  const std::string at = point_text(point, " ");
  return at.empty() || system.empty() ? system + at : system + ", " + at;
}

std::filesystem::path SweepCell::folder() const {
  std::filesystem::path folder;
  if (!system.empty()) folder /= folder_name(system);
  if (!point.empty()) folder /= folder_name(point_text(point, ","));
  return folder;
}

SweepSpec load_sweep_spec(const std::filesystem::path& file) {
  auto spec = YamlDocument::load(file).read<SweepSpec>();
  if (spec.seeds.empty()) return spec;
  try {
    parse_seeds(spec.seeds);
  } catch (const Error& error) {
    fail("{}: seeds: {}", file.string(), error.what());
  }
  return spec;
}

std::vector<SweepCell> cells_of(const SweepSpec& spec) {
  std::vector<std::map<std::string, std::string>> points{{}};
  for (const auto& [key, values] : spec.grid) {
    std::vector<std::map<std::string, std::string>> finer;
    for (const auto& point : points) {
      for (const std::string& value : values) {
        finer.push_back(point);
        finer.back()[key] = value;
      }
    }
    points = std::move(finer);
  }
  std::map<std::string, std::map<std::string, std::string>> systems = spec.systems;
  if (systems.empty()) systems[""];
  std::vector<SweepCell> cells;
  for (const std::string& scenario : spec.scenarios) {
    std::set<std::filesystem::path> folders;
    for (const auto& [system, keys] : systems) {
      for (const auto& point : points) {
        SweepCell cell{scenario, system, point};
        for (const auto& values : {spec.set, keys, point}) {
          cell.overrides.insert(cell.overrides.end(), values.begin(), values.end());
        }
        if (!folders.insert(cell.folder()).second) {
          fail("sweep: two settings would have the folder {}: is a value of the grid there twice?",
               cell.folder().string());
        }
        cells.push_back(std::move(cell));
      }
    }
  }
  return cells;
}

}  // namespace vinebench::harness
