// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vinebench {

/// Escapes text for XML elements and attributes: markup and line ends are escaped, characters not
/// allowed in XML are removed.
std::string xml_escaped(const std::string& text);

}  // namespace vinebench
