// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/occluders/occluders.h"

#include <map>

#include "sim/vineyard/occluders/occluder_shape.h"
#include "sim/world/occluder_pose.h"

namespace vinebench::sim {

void add_occluders(Scene& scene, const WorldConfig& world, const Terrain& terrain,
                   std::uint64_t seed) {
  std::map<Occluder::List, int> counts;
  for (const Occluder& occluder : world.occluders) {
    OccluderModel model = shape_of(occluder).model(occluder, seed);
    model.asset.model.name = name_of(occluder);
    model.asset.update_bounds();
    Pose pose = occluder_pose(occluder, terrain);
    pose.translation += pose.rotation * (model.origin * Eigen::Vector3d::UnitZ());
    scene.instances.push_back({add_asset(scene, std::move(model.asset)), pose,
                               static_cast<float>(model.scale), counts[occluder.list]++});
  }
}

}  // namespace vinebench::sim
