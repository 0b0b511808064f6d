// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vinebench::harness {

/// The result of measure_rendering() for one world as a human-readable table.
std::string render_table(const nlohmann::ordered_json& world);

}  // namespace vinebench::harness
