// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/labels.h"

#include <array>

namespace vinebench {

std::string name_of(Thing thing) {
  static const std::array<const char*, 10> kNames{"none", "ground", "vine",  "post",  "tag",
                                                  "box",  "person", "rover", "cover", "occluder"};
  return kNames.at(static_cast<std::size_t>(thing));
}

}  // namespace vinebench
