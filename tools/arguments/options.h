// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/config/override.h"
#include "harness/run.h"
#include "tools/arguments/command.h"

namespace vinebench::tools {

// Options that several commands have.

/// --set, with the help's first part; may be repeated.
Option overrides_option(std::vector<std::string>& texts, const std::string& help);

/// Each of the texts as KEY=VALUE. Throws Error.
std::vector<Override> parse_overrides(const std::vector<std::string>& texts);

/// --threads. default_threads() is the machine's number.
Option threads_option(int& threads);
int default_threads();

/// --jobs, of runs side by side.
Option jobs_option(int& jobs);

/// --cache, of a command that needs plants, and the machine with the folder that it names.
Option cache_option(std::filesystem::path& folder);
harness::Machine with_cache(harness::Machine machine, const std::filesystem::path& folder);

/// WORLD and --route, of a drive through a world that is planned.
std::vector<Option> drive_options(std::string& world, std::string& route);

/// --untrusted.
Option untrusted_option(bool& untrusted);

/// --json, of a benchmark.
Option json_option(std::string& file);

/// --load-map, --save-map, --save-cloud.
std::vector<Option> map_options(harness::MapFiles& maps);

void append(std::vector<Option>& options, const std::vector<Option>& more);

/// The value of an enum by its name, which must be one of yaml_names().
template <class Enum>
void choose(Enum& value, const std::string& name) {
  const std::vector<std::string> names = yaml_names(Enum{});
  value = static_cast<Enum>(std::ranges::find(names, name) - names.begin());
}

}  // namespace vinebench::tools
