// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/assets/asset.h"

namespace vinebench::sim {

/// The axis of a mesh file's coordinates that points up; kFile is that of the file, or its format.
enum class UpAxis { kFile, kX, kY, kZ };

inline std::vector<std::string> yaml_names(UpAxis) {
  return {"file", "x", "y", "z"};
}

/// What becomes of parts that a mesh can be drawn without, such as an image that is missing: an
/// Error, or a note.
enum class Strictness { kStrict, kLenient };

/// Differences between a file and what is drawn of it, each once.
class ImportNotes {
 public:
  void add(const std::string& note) {
    if (known_.insert(note).second) notes_.push_back(note);
  }
  const std::vector<std::string>& all() const { return notes_; }

 private:
  std::vector<std::string> notes_;
  std::set<std::string> known_;
};

/// Exchanges the front and the back of all triangles.
inline void turn_over(std::vector<std::uint32_t>& indices) {
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
}

/// A mesh file as it was read, in its own unit, z up.
struct ImportedMesh {
  /// A mesh or node of the file.
  struct Part {
    std::string name;
    int around = -1;  ///< index into parts of what it is in; -1 for none
  };

  Asset asset;
  UpAxis up_axis = UpAxis::kZ;  ///< that of the file
  std::vector<Part> parts;
  std::vector<int> part_of;  ///< part of each primitive, level by level
  std::set<int> labelled;    ///< materials whose label is the file's own
  ImportNotes notes;

  /// The new part's index.
  int add_part(const std::string& name, int around) {
    constexpr std::size_t kLongest = 200;
    parts.push_back({name.substr(0, kLongest), around});
    return static_cast<int>(parts.size()) - 1;
  }
};

}  // namespace vinebench::sim
