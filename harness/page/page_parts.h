// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace vinebench::harness {

// Made from harness/page/web when the program is built, and part of it.

/// The page's program, JavaScript without any import.
std::string_view page_script();

std::string_view page_style();

}  // namespace vinebench::harness
