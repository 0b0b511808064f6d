// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vinebench {

/// Names and values, in a fixed order.
using NamedValues = std::vector<std::pair<std::string, std::string>>;

/// What computes in this process: whose elementary functions, which code of OpenCV, how shaders
/// multiply and add, which BLAS. Two processes of one build with the same values compute the same
/// bytes; a value that depends on the processor names its features.
NamedValues arithmetic_of_process();

/// The same on one line.
std::string arithmetic_text();

/// The processor's vendor, family, model and those features by which libraries choose their code.
std::string processor_text();

}  // namespace vinebench
