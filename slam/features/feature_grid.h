// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "slam/features/features.h"

namespace vinebench::slam {

/// Files the keypoints of an image by cells, so that those near a point are found at once.
class FeatureGrid {
 public:
  FeatureGrid() = default;
  FeatureGrid(const std::vector<Keypoint>& keypoints, int width, int height);

  /// Appends the indices of keypoints within `radius` px (a square window, |dx| and |dy|) of (x, y)
  /// whose level lies in [min_level, max_level], in ascending order of cell, then index.
  void query(float x, float y, float radius, int min_level, int max_level,
             std::vector<int>& result) const;

 private:
  static constexpr int kCell = 16;  ///< px

  /// What a query needs to know of a keypoint, where it was when it was filed.
  struct Item {
    float x = 0;  ///< px
    float y = 0;
    std::uint32_t index : 24 = 0;
    std::uint32_t level : 8 = 0;
  };

  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> cell_begin_;  ///< offsets into items_, one a cell and one past the last
  std::vector<Item> items_;      ///< cell after cell, in a cell by index
};

}  // namespace vinebench::slam
