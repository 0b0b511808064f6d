// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vinebench::harness {

/// Names and versions of the libraries that simulate and draw. Starts OpenGL.
std::vector<std::pair<std::string, std::string>> simulation_versions();

}  // namespace vinebench::harness
