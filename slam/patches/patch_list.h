// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "slam/patches/patch.h"

namespace vinebench::slam {

/// The patches of a keyframe's features in one view. Many features have none, and patches are most
/// of what a map takes of memory, so that only those that are there take room.
class PatchList {
 public:
  explicit PatchList(std::size_t features = 0) : places_(features, kNone) {}

  std::size_t size() const { return places_.size(); }  ///< features

  /// Null where the feature has none.
  const Patch* find(std::size_t feature) const {
    const int place = places_[feature];
    return place == kNone ? nullptr : &patches_[static_cast<std::size_t>(place)];
  }

  /// Gives a feature that has none its patch.
  void add(std::size_t feature, const Patch& patch) {
    places_[feature] = static_cast<int>(patches_.size());
    patches_.push_back(patch);
  }

  /// Drops the patches of features that have no landmark (-1).
  void keep_tied(const std::vector<int>& landmarks) {
    PatchList kept(size());
    for (std::size_t f = 0; f < size(); ++f) {
      const Patch* patch = find(f);
      if (patch != nullptr && landmarks[f] >= 0) kept.add(f, *patch);
    }
    kept.close();
    *this = std::move(kept);
  }

  /// No more will be added: gives back the room for them.
  void close() { patches_.shrink_to_fit(); }

 private:
  static constexpr int kNone = -1;

  std::vector<int> places_;  ///< in patches_, of each feature
  std::vector<Patch> patches_;
};

}  // namespace vinebench::slam
