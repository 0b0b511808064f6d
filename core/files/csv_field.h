// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vinebench {

/// A text as a field of a CSV file (RFC 4180): in quotes where it needs them, and on one line:
/// control characters become '_'.
std::string csv_field(std::string text);

}  // namespace vinebench
