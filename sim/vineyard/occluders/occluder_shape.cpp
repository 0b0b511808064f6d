// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/occluders/occluder_shape.h"

#include <array>

namespace vinebench::sim {

const OccluderShape& shape_of(const Occluder& occluder) {
  // In the order of Occluder::Shape.
  static constexpr std::array<OccluderShape, 6> kShapes{{{box_model, whole_block},
                                                         {person_model, person_blocks},
                                                         {crate_model, whole_block},
                                                         {cylinder_model, whole_block},
                                                         {sheet_model, whole_block},
                                                         {mesh_model, whole_block}}};
  return kShapes.at(static_cast<std::size_t>(occluder.shape));
}

std::vector<Block> whole_block(const Occluder& occluder) {
  const Eigen::Vector3d half = size_of(occluder) / 2;
  return {{half.z() * Eigen::Vector3d::UnitZ(), half}};
}

}  // namespace vinebench::sim
