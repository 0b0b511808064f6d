// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vinebench {

/// Text as it may stand in XML, between tags and in attributes: markup and line ends escaped,
/// characters that XML does not have left out.
std::string xml_escaped(const std::string& text);

}  // namespace vinebench
