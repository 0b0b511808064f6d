// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vinebench::harness {

/// Names and versions of the libraries that simulate and draw. Starts OpenGL on the platform of
/// that name (as choose_backend()).
std::vector<std::pair<std::string, std::string>> simulation_versions(const std::string& platform);

}  // namespace vinebench::harness
