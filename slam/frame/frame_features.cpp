// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/frame/frame_features.h"

#include <algorithm>

namespace vinebench::slam {

Associations no_associations(const FrameFeatures& frame) {
  Associations none;
  for (const StereoView& view : frame.views) none.emplace_back(view.features.size(), -1);
  return none;
}

std::vector<int> landmark_ids(const Associations& associations) {
  std::vector<int> ids;
  for (const std::vector<int>& view : associations) {
    for (const int id : view) {
      if (id >= 0) ids.push_back(id);
    }
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace vinebench::slam
