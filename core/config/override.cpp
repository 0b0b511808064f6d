// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/override.h"

#include "core/util/error.h"

namespace vinebench {

Override parse_override(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    fail("--set {}: expected KEY=VALUE, such as world.sun.elevation_deg=20", text);
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace vinebench
