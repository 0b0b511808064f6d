// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace vinebench::harness {

/// A JSON file. Throws Error with the file and the reason: it cannot be read, is too large, nested
/// too deeply or not valid.
nlohmann::ordered_json read_json(const std::filesystem::path& file);

/// The value as text, on one line or with this indent. Bytes that are not UTF-8, as names of files
/// may have them, are replaced by U+FFFD: JSON cannot hold them, and a finished run is worth more
/// than the name of its folder.
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace vinebench::harness
