// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "core/truth/occlusion.h"
#include "sim/assets/foreign/mesh_import.h"
#include "sim/world/occluders/occluder_path.h"

namespace vinebench::sim {

/// Something that may stand, lie or hang between a camera and the vineyard. Its frame: the middle
/// of its foot, x ahead (where a person looks), z up; m.
struct Occluder {
  /// How it is drawn and what the rover bumps into: each has an entry in shape_of().
  enum class Shape { kBox, kPerson, kCrate, kCylinder, kSheet, kMesh };
  /// Which list of its file it stands in; also the order in which occluders are drawn and counted.
  enum class List { kBoxes, kObstacles, kOccluders };

  std::string name{};                     ///< for people; that of its class where empty
  Shape shape = Shape::kBox;              ///< how it is drawn and what the rover bumps into
  std::optional<OccluderClass> kind{};    ///< `class` in YAML; the shape's usual one if absent
  std::optional<Eigen::Vector3d> size{};  ///< m, along its x, y, z; the shape's usual if absent
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< m, middle of its foot
  double lift = 0;                                     ///< m, of its foot above the ground
  double yaw_deg = 0;                                  ///< to the left
  double height = 1.75;                                ///< m, of a person, who has no `size`
  std::optional<Eigen::Vector3d> colour{};             ///< sRGB, 0 to 1; a person's is the shirt's
  bool printed = false;                         ///< a box with a maker's mark, text and symbols
  std::int64_t print_seed = 0;                  ///< which print
  std::optional<std::filesystem::path> mesh{};  ///< .glb, .gltf, .dae, .obj or .stl; fills `size`
  std::optional<MeshImport> mesh_import{};      ///< of the mesh, before it is scaled to `size`
  /// In place of `position`; `yaw_deg` is then added to the heading of its motion.
  std::optional<OccluderPath> path{};
  List list = List::kOccluders;

  friend std::vector<std::string> yaml_names(Shape) {
    return {"box", "person", "crate", "cylinder", "sheet", "mesh"};
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive("name", name);
    archive("shape", shape);
    archive("class", kind);
    archive("size", size, Range::between(0.001, 100));
    archive("position", position, Range::between(-5000, 5000));
    archive("lift", lift, Range::between(-10, 100));
    archive("yaw_deg", yaw_deg, Range::between(-360, 360));
    archive("height", height, Range::between(0.5, 2.5));
    archive("colour", colour, Range::between(0, 1));
    archive("printed", printed);
    archive("print_seed", print_seed, Range::non_negative());
    archive("mesh", mesh);
    archive("mesh_import", mesh_import);
    archive("path", path);
    archive.require(!path || position.isZero(), "position",
                    "expected none beside a path, which begins at its first waypoint");
    archive.require(mesh.has_value() == (shape == Shape::kMesh), "mesh",
                    "expected a file where the shape is mesh, and for no other shape");
    archive.require(!mesh_import || shape == Shape::kMesh, "mesh_import",
                    "expected only where the shape is mesh");
    archive.require(!mesh_import || mesh_import->scale == 1, "mesh_import",
                    "expected no `scale`: the mesh is scaled to `size`");
    archive.require(size.has_value() || shape != Shape::kMesh, "size",
                    "expected the size that the mesh is scaled to, in m");
    archive.require(!size || shape != Shape::kPerson, "size",
                    "expected `height` in its place for a person");
  }
};

/// What an occluder is counted as.
OccluderClass class_of(const Occluder& occluder);

/// The name given, else that of its class.
std::string name_of(const Occluder& occluder);

/// m, along its x, y, z.
Eigen::Vector3d size_of(const Occluder& occluder);

/// sRGB, 0 to 1.
Eigen::Vector3d colour_of(const Occluder& occluder);

}  // namespace vinebench::sim
