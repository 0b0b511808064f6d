// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/occluders/occluders.h"

#include <map>

#include "sim/vineyard/occluders/occluder_shape.h"
#include "sim/world/occluder_pose.h"

namespace vinebench::sim {

void add_occluders(Scene& scene, const WorldConfig& world, const WorldLayout& layout,
                   std::uint64_t seed) {
  std::map<Occluder::List, int> counts;
  for (std::size_t i = 0; i < world.occluders.size(); ++i) {
    const Occluder& occluder = world.occluders[i];
    OccluderModel model = shape_of(occluder).model(occluder, seed);
    model.asset.model.name = name_of(occluder);
    model.asset.update_bounds();
    const Pose T_occluder_model{Eigen::Quaterniond::Identity(), {0, 0, model.origin}};
    if (occluder.path) {
      scene.motions.push_back(
          {static_cast<int>(scene.instances.size()),
           [motion = OccluderMotion(occluder, layout.terrain), T_occluder_model](Stamp stamp) {
             return motion.at(stamp) * T_occluder_model;
           }});
    }
    Pose pose = layout.occluders[i];
    pose.translation += pose.rotation * (model.origin * Eigen::Vector3d::UnitZ());
    scene.instances.push_back({add_asset(scene, std::move(model.asset)), pose,
                               static_cast<float>(model.scale), counts[occluder.list]++});
  }
}

}  // namespace vinebench::sim
