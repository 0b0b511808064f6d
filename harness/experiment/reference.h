// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/config/field_list.h"

namespace vinebench::harness {

/// A kind of file that the program reads, with all its keys.
struct FileKeys {
  std::string name;         ///< "scenario"
  std::string description;  ///< a sentence
  std::vector<ConfigField> keys;
};

/// Scenarios (with world and rover), rigs, cultivars, randomisations: what their readers accept.
std::vector<FileKeys> file_keys();

}  // namespace vinebench::harness
