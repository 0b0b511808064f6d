// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/truth/labels.h"

namespace vinebench {

/// What may stand or hang between a camera and the vineyard. A new class goes to the end; it needs
/// a name (yaml_names), a label of its own (label_of) and an entry of the label table.
enum class OccluderClass { kCarton, kCrate, kPerson, kTarpaulin, kLeaf, kOther };
inline constexpr std::size_t kOccluderClasses = 6;

/// "carton", "crate" and so on, in the order of OccluderClass.
std::vector<std::string> yaml_names(OccluderClass);
std::string name_of(OccluderClass occluder);

/// What label images call its pixels. No two classes share a label.
Label label_of(OccluderClass occluder);

/// How much of one camera's image occluders cover, class by class.
struct Occlusion {
  std::array<double, kOccluderClasses> shares{};  ///< of the pixels, 0 to 1, by OccluderClass

  double share(OccluderClass occluder) const { return shares[static_cast<std::size_t>(occluder)]; }
  double& share(OccluderClass occluder) { return shares[static_cast<std::size_t>(occluder)]; }
  /// Of all classes together, 0 to 1.
  double total() const;
  /// The class that covers most; the first one where several are equal.
  OccluderClass largest() const;
};

}  // namespace vinebench
