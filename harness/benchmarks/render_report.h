// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vinebench::harness {

/// What measure_rendering() found of one world, as a table for people.
std::string render_table(const nlohmann::ordered_json& world);

}  // namespace vinebench::harness
