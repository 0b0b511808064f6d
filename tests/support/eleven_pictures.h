// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "harness/realism/picture_set.h"

namespace vinebench::test {

/// Pictures with the values 1 to 11 times `scale` of one statistic.
inline harness::PictureSet eleven(const char* name, double scale) {
  harness::PictureSet set{.name = name, .width = 752, .pictures = {}};
  for (int i = 1; i <= 11; ++i) {
    set.pictures.push_back({"", std::to_string(i), {}, {{"corners", scale * i}}});
  }
  return set;
}

}  // namespace vinebench::test
