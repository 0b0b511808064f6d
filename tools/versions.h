// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vinebench::tools {

/// The program's version and those of the libraries it runs with, a line each.
std::string versions_text();

}  // namespace vinebench::tools
