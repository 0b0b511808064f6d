// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <string>

namespace vinebench::tools {

/// $VINEBENCH_GL, the GL platform for scenarios that leave it open; empty where unset.
inline std::string gl_variable() {
  const char* value = std::getenv("VINEBENCH_GL");
  return value == nullptr ? "" : value;
}

}  // namespace vinebench::tools
