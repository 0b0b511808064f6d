// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/datasets/formats.h"
#include "tools/commands/commands.h"

namespace vinebench::tools {
namespace {

/// A heading and lines of a name and what it is.
struct Section {
  std::string title;
  std::vector<std::pair<std::string, std::string>> lines;
};

Section section_of(const harness::Catalogue& catalogue, const char* title, harness::DataKind kind) {
  Section section{title, {}};
  for (const harness::DataEntry& entry : catalogue.list(kind)) {
    section.lines.emplace_back(entry.name, entry.description);
  }
  return section;
}

Section format_section() {
  Section section{"formats", {}};
  for (const harness::DatasetFormat& format : harness::dataset_formats()) {
    section.lines.emplace_back(
        format.name, format.description + (format.available ? "" : " (not in this build)"));
  }
  return section;
}

std::vector<Section> sections_of(const harness::Catalogue& catalogue) {
  return {section_of(catalogue, "scenarios", harness::DataKind::kScenario),
          section_of(catalogue, "worlds", harness::DataKind::kWorld),
          section_of(catalogue, "rovers", harness::DataKind::kRover),
          section_of(catalogue, "rigs", harness::DataKind::kRig),
          section_of(catalogue, "randomisations", harness::DataKind::kRandomisation),
          format_section()};
}

void print(const Section& section) {
  std::size_t width = 0;
  for (const auto& [name, text] : section.lines) width = std::max(width, name.size());
  fmt::print("{}\n", section.title);
  if (section.lines.empty()) fmt::print("  none found\n");
  for (const auto& [name, text] : section.lines) {
    const std::string line = fmt::format("  {:<{}}  {}", name, width, text);
    fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  }
}

int list(const std::string& kind, const harness::Catalogue& catalogue) {
  bool first = true;
  for (const Section& section : sections_of(catalogue)) {
    if (!kind.empty() && section.title != kind) continue;
    if (!first) fmt::print("\n");
    print(section);
    first = false;
  }
  return 0;
}

}  // namespace

Command list_command(const Surroundings& surroundings) {
  const auto kind = std::make_shared<std::string>();
  return {.name = "list",
          .description = "List the scenarios, worlds, rovers, rigs and formats that have a name",
          .options = {{.name = "KIND",
                       .target = kind.get(),
                       .help = "Which (default: all)",
                       .choices = {"scenarios", "worlds", "rovers", "rigs", "randomisations",
                                   "formats"}}},
          .run = [kind, surroundings] { return list(*kind, surroundings.catalogue); }};
}

}  // namespace vinebench::tools
