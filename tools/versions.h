// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "harness/machine.h"

namespace vinebench::tools {

/// The versions of the program and its libraries, one a line. Starts OpenGL where
/// the program draws.
std::string versions_text(const harness::Machine& machine);

}  // namespace vinebench::tools
