// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace vinebench::tools {

/// The exit code of `run`, which does what these arguments of the program say. Bad input and a
/// failing environment, also where a library throws, are one message on standard error and exit
/// code 2; another exception is an error of the program, exit code 3.
int outcome_of(const std::vector<std::string>& arguments, const std::function<int()>& run);

}  // namespace vinebench::tools
