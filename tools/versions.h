// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vinebench::tools {

/// The versions of the program and its libraries, one a line.
std::string versions_text();

}  // namespace vinebench::tools
