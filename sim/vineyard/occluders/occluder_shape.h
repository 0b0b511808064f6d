// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "sim/assets/asset.h"
#include "sim/world/occluders/occluder.h"

namespace vinebench::sim {

/// An upright block in an occluder's frame.
struct Block {
  Eigen::Vector3d centre;  ///< m
  Eigen::Vector3d half;    ///< m
};

/// What is drawn of an occluder. Its materials have the label of its class.
struct OccluderModel {
  Asset asset{};
  double origin = 0;  ///< m, of the model's origin above the occluder's foot
  double scale = 1;   ///< of the model
};

/// How a shape is drawn, and what the rover bumps into: blocks in the occluder's frame.
struct OccluderShape {
  OccluderModel (*model)(const Occluder& occluder, std::uint64_t seed);
  std::vector<Block> (*blocks)(const Occluder& occluder);
};

/// The entry of a shape in the one list of them.
const OccluderShape& shape_of(const Occluder& occluder);

// The models, one a file.
OccluderModel box_model(const Occluder& occluder, std::uint64_t seed);
OccluderModel person_model(const Occluder& occluder, std::uint64_t seed);
OccluderModel crate_model(const Occluder& occluder, std::uint64_t seed);
OccluderModel cylinder_model(const Occluder& occluder, std::uint64_t seed);
OccluderModel sheet_model(const Occluder& occluder, std::uint64_t seed);
/// Throws Error that names the mesh's file.
OccluderModel mesh_model(const Occluder& occluder, std::uint64_t seed);

/// One block of the occluder's size.
std::vector<Block> whole_block(const Occluder& occluder);
std::vector<Block> person_blocks(const Occluder& occluder);

}  // namespace vinebench::sim
