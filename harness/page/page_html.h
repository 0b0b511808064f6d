// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vinebench::harness {

/// One HTML page that needs no other file: the front end, what it shows (`Report` of
/// harness/page/web/types.ts), and further elements that this names.
std::string page_html(const std::string& title, const nlohmann::ordered_json& report,
                      const std::string& elements);

}  // namespace vinebench::harness
