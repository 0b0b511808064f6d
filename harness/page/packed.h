// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vinebench::harness {

/// A value for a page, which opens it when it is looked at: gzip of its JSON text, in base64.
std::string packed(const nlohmann::ordered_json& value);

/// JSON text that may stand within a <script> element of HTML.
std::string script_text(const nlohmann::ordered_json& value);

}  // namespace vinebench::harness
