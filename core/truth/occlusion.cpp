// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/truth/occlusion.h"

#include <algorithm>
#include <numeric>

namespace vinebench {

std::vector<std::string> yaml_names(OccluderClass) {
  return {"carton", "crate", "person", "tarpaulin", "leaf", "other"};
}

std::string name_of(OccluderClass occluder) {
  return yaml_names(occluder).at(static_cast<std::size_t>(occluder));
}

Label label_of(OccluderClass occluder) {
  static constexpr std::array<Label, kOccluderClasses> kClasses{
      Label::kBox,       Label::kCrate,     Label::kPerson,
      Label::kTarpaulin, Label::kLooseLeaf, Label::kOccluder};
  return kClasses.at(static_cast<std::size_t>(occluder));
}

double Occlusion::total() const {
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

OccluderClass Occlusion::largest() const {
  return static_cast<OccluderClass>(std::ranges::max_element(shares) - shares.begin());
}

}  // namespace vinebench
