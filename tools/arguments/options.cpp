// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/arguments/options.h"

#include <thread>

namespace vinebench::tools {

Option overrides_option(std::vector<std::string>& texts, const std::string& help) {
  return {
      .name = "--set", .target = &texts, .help = help + "; may be repeated", .type = "KEY=VALUE"};
}

std::vector<Override> parse_overrides(const std::vector<std::string>& texts) {
  std::vector<Override> overrides;
  for (const std::string& text : texts) overrides.push_back(parse_override(text));
  return overrides;
}

Option jobs_option(int& jobs) {
  return {.name = "--jobs",
          .target = &jobs,
          .help = "Runs side by side, which share the threads",
          .show_default = true,
          .range = Range::between(1, 256)};
}

Option threads_option(int& threads) {
  return {.name = "--threads",
          .target = &threads,
          .help = "Threads to share the work; changes no result",
          .show_default = true,
          .range = Range::between(1, 256)};
}

int default_threads() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

std::vector<Option> drive_options(std::string& world, std::string& route) {
  return {{.name = "WORLD",
           .target = &world,
           .help = "World file (YAML), or the name of a world",
           .required = true,
           .data = harness::DataKind::kWorld},
          {.name = "--route",
           .target = &route,
           .help = "Scenario whose route and rover drive there",
           .type = "SCENARIO",
           .required = true,
           .data = harness::DataKind::kScenario}};
}

Option cache_option(std::filesystem::path& folder) {
  return {.name = "--cache",
          .target = &folder,
          .help =
              "Folder of generated plants (default: $VINEBENCH_CACHE, else vinebench in the "
              "user's cache); changes no result",
          .type = "FOLDER"};
}

harness::Machine with_cache(harness::Machine machine, const std::filesystem::path& folder) {
  if (!folder.empty()) machine.plant_cache.folder = folder;
  return machine;
}

Option untrusted_option(bool& untrusted) {
  return {.name = "--untrusted",
          .target = &untrusted,
          .help =
              "Refuse a scenario that executes programs, loads code or names files outside of "
              "its own folder and the program's data"};
}

Option json_option(std::string& file) {
  return {.name = "--json",
          .target = &file,
          .help = "Also write the results to this file",
          .type = "FILE"};
}

std::vector<Option> map_options(harness::MapFiles& maps) {
  return {{.name = "--load-map",
           .target = &maps.load,
           .help = "Map of an earlier run to go on with",
           .type = "FILE",
           .existing = Existing::kFile},
          {.name = "--save-map",
           .target = &maps.save,
           .help = "File for the map in the end",
           .type = "FILE"},
          {.name = "--save-cloud",
           .target = &maps.cloud,
           .help = "File for its landmarks (PLY)",
           .type = "FILE"}};
}

void append(std::vector<Option>& options, const std::vector<Option>& more) {
  options.insert(options.end(), more.begin(), more.end());
}

}  // namespace vinebench::tools
