// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/config/override.h"
#include "harness/catalogue/catalogue.h"
#include "harness/machine.h"
#include "python/arrays.h"

namespace vinebench::python {

/// Keys and values of Python as overrides of YAML: numbers, truth values, texts, and lists and
/// dicts of them.
std::vector<Override> overrides_of(const std::map<std::string, py::object>& set);

/// What this process has: plants are kept as by the program, and where they cannot be, that is a
/// RuntimeWarning.
harness::Machine machine();

/// The file that a text means, as on the command line: a file, or a name of the program's data.
std::filesystem::path data_file(harness::DataKind kind, const std::filesystem::path& text);

/// The names of the program's data of a kind, sorted.
std::vector<std::string> data_names(harness::DataKind kind);

}  // namespace vinebench::python
