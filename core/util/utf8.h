// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace vinebench {

/// The text with each byte that is no part of valid UTF-8 replaced by U+FFFD, for formats that
/// require UTF-8: names of files may be any bytes.
std::string valid_utf8(std::string_view text);

}  // namespace vinebench
