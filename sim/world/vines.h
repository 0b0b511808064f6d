// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config_field.h"
#include "sim/assets/foreign/mesh_import.h"

namespace vinebench::sim {

/// The training of the vine's old wood along the wire.
enum class Training { kBilateralCordon, kUnilateralCordon, kSingleGuyot, kDoubleGuyot };

inline std::vector<std::string> yaml_names(Training) {
  return {"bilateral_cordon", "unilateral_cordon", "single_guyot", "double_guyot"};
}

/// Why `bbch` is not a supported growth stage; empty if it is.
std::string bbch_problem(int bbch);

/// The vines of a vineyard. docs/plants.md has common values and sources.
struct VinesConfig {
  std::filesystem::path cultivar;                  ///< YAML file; empty: the built-in red cultivar
  Training training = Training::kBilateralCordon;  ///< of the old wood along the wire
  int bbch = 89;                                   ///< growth stage: 0, 9, 65, 75, 79, 83, 89 or 95
  double spacing = 1.0;                            ///< m between plants
  double lowest_bunch = 0.60;                      ///< m above ground
  double canopy_top = 1.5;                         ///< m above ground
  double canopy_depth = 0.30;                      ///< m across the row
  double shoots = 13;                              ///< of this year, a metre of row
  double bunches = 1.0;                            ///< a shoot, on average
  double leaf_area = 2.0;     ///< m^2, one side of every blade of a metre of row in full leaf
  double leaf_removal = 0.5;  ///< share of the leaves removed in the fruit zone
  double pruned = 0;          ///< share of dormant vines whose canes are cut already
  double missing = 0;         ///< share of missing vines
  double young = 0;           ///< share of second-year vines
  int templates = 6;          ///< number of different plants
  /// Meshes to use instead of generated plants (.glb .gltf .stl .obj .dae), z up (glTF: y up), m.
  std::vector<std::filesystem::path> meshes;
  std::optional<MeshImport> mesh_import{};  ///< of all `meshes`
  template <class Archive>
  void serialize(Archive& archive) {
    archive("cultivar", cultivar);
    archive("training", training);
    archive("bbch", bbch);
    archive("spacing", spacing, Range::between(0.2, 20));
    archive("lowest_bunch", lowest_bunch, Range::between(0.1, 3));
    archive("canopy_top", canopy_top, Range::between(0.3, 5));
    archive("canopy_depth", canopy_depth, Range::between(0.05, 3));
    archive("shoots", shoots, Range::between(1, 40));
    archive("bunches", bunches, Range::between(0, 4));
    archive("leaf_area", leaf_area, Range::between(0.1, 8));
    archive("leaf_removal", leaf_removal, Range::between(0, 1));
    archive("pruned", pruned, Range::between(0, 1));
    archive("missing", missing, Range::between(0, 1));
    archive("young", young, Range::between(0, 1));
    archive("templates", templates, Range::between(1, 64));
    archive("meshes", meshes);
    archive("mesh_import", mesh_import);
    archive.require(!mesh_import || !meshes.empty(), "mesh_import", "expected only with `meshes`");
    archive.require(canopy_top > lowest_bunch, "canopy_top", "expected more than lowest_bunch");
    archive.require(missing + young <= 1, "young", "expected at most 1 together with missing");
    const std::string problem = bbch_problem(bbch);
    archive.require(problem.empty(), "bbch", problem);
  }
};

}  // namespace vinebench::sim
