// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/config/config_field.h"

#include <fmt/format.h>

#include <cmath>

#include "core/util/error.h"

namespace vinebench {

std::string Range::text() const {
  const bool has_min = std::isfinite(min);
  const bool has_max = std::isfinite(max);
  if (has_min && has_max) {
    return fmt::format("a number {} {} and at most {}", above_min ? "above" : "of at least", min,
                       max);
  }
  if (has_min) {
    return above_min ? fmt::format("a number above {}", min)
                     : fmt::format("a number of at least {}", min);
  }
  return has_max ? fmt::format("a number of at most {}", max) : "a finite number";
}

void throw_violations(const std::vector<std::string>& violations) {
  if (violations.empty()) return;
  std::string text;
  for (const std::string& violation : violations) text += (text.empty() ? "" : "\n") + violation;
  throw Error(text);
}

}  // namespace vinebench
