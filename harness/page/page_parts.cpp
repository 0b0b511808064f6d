// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/page/page_parts.h"

namespace vinebench::harness {

std::string_view page_script() {
  static const char text[] =
#include "vinebench/page_script.inc"
      ;
  return {text, sizeof(text) - 1};
}

std::string_view page_style() {
  static const char text[] =
#include "vinebench/page_style.inc"
      ;
  return {text, sizeof(text) - 1};
}

}  // namespace vinebench::harness
