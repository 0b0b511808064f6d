// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/world/occluders/occluder.h"

namespace vinebench::sim {

/// An entry of the list `boxes`, the older form of an occluder of the shape box.
struct BoxEntry {
  std::string name = "carton";                         ///< for messages
  Eigen::Vector3d size{0.6, 0.4, 0.4};                 ///< m, along its own x, y, z
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, middle of its foot
  double yaw_deg = 0;                                  ///< to the left
  Eigen::Vector3d colour{0.42, 0.29, 0.18};            ///< sRGB, 0 to 1
  bool printed = false;                                ///< with a print on its sides
  std::int64_t print_seed = 0;                         ///< of the print
  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("size", size, Range::between(0.01, 10));
    archive("position", position, Range::between(-5000, 5000));
    archive("yaw_deg", yaw_deg, Range::between(-360, 360));
    archive("colour", colour, Range::between(0, 1));
    archive("printed", printed);
    archive("print_seed", print_seed, Range::non_negative());
  }
};

/// An entry of the list `obstacles`, the older form of an occluder of the shape person or crate.
struct ObstacleEntry {
  enum class Kind { kPerson, kCrate };
  Kind kind = Kind::kPerson;                           ///< which shape
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, middle of its foot
  double yaw_deg = 0;                                  ///< to the left
  double height = 1.75;                                ///< m, of a person
  Eigen::Vector3d colour{0.16, 0.30, 0.55};            ///< sRGB, 0 to 1
  friend std::vector<std::string> yaml_names(Kind) { return {"person", "crate"}; }
  template <class Archive>
  void serialize(Archive& archive) {
    archive("kind", kind);
    archive("position", position, Range::between(-5000, 5000));
    archive("yaw_deg", yaw_deg, Range::between(-360, 360));
    archive("height", height, Range::between(0.5, 2.5));
    archive("colour", colour, Range::between(0, 1));
  }
};

/// Occluders by the list that they stand in. A run's resolved configuration keeps the form of its
/// file.
struct OccluderLists {
  std::vector<BoxEntry> boxes;
  std::vector<ObstacleEntry> obstacles;
  std::optional<std::vector<Occluder>> occluders;  ///< absent where it is empty
};
OccluderLists split(const std::vector<Occluder>& occluders);

/// All of them as one list, in the order of Occluder::List.
std::vector<Occluder> join(const OccluderLists& lists);

/// Adds `more` to `occluders`; the order of the lists holds, and within each, these come last.
void append_occluders(std::vector<Occluder>& occluders, const std::vector<Occluder>& more);

/// The keys of a world's or (without `obstacles`) a scenario's occluders.
template <class Archive>
void serialize_occluders(Archive& archive, std::vector<Occluder>& occluders, bool with_obstacles) {
  OccluderLists lists = split(occluders);
  archive("boxes", lists.boxes);
  if (with_obstacles) archive("obstacles", lists.obstacles);
  archive("occluders", lists.occluders);
  occluders = join(lists);
}

}  // namespace vinebench::sim
