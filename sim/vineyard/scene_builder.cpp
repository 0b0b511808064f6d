// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "core/util/random.h"
#include "sim/assets/foreign/foreign_mesh.h"
#include "sim/plants/grapevine.h"
#include "sim/plants/grapevine_stage.h"
#include "sim/plants/plant_cache.h"
#include "sim/vineyard/ground.h"
#include "sim/vineyard/occluders/occluders.h"
#include "sim/vineyard/props.h"
#include "sim/vineyard/trellis.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {
namespace {

/// Models to choose from for each place of a row.
struct PlantModels {
  std::vector<int> grown;
  std::vector<int> young;
};

/// The world's own meshes, or the plants that are grown for it.
PlantModels add_plants(Scene& scene, const WorldConfig& world, std::uint64_t seed,
                       const CacheFolder& cache) {
  PlantModels models;
  const MeshImport import = world.vines.mesh_import.value_or(MeshImport{});
  for (Asset& plant :
       load_foreign_meshes(world.vines.meshes, import, std::nullopt, "vines.mesh_import")) {
    plant.model.thing = Thing::kVine;  // whatever the labels of its parts
    models.grown.push_back(add_asset(scene, std::move(plant)));
  }
  models.young = models.grown;
  if (!models.grown.empty()) return models;
  PlantSet plants = cached_plants(world.vines, seed, cache);
  for (Asset& plant : plants.grown) models.grown.push_back(add_asset(scene, std::move(plant)));
  for (Asset& plant : plants.young) models.young.push_back(add_asset(scene, std::move(plant)));
  return models;
}

/// Plants in their rows: which template, which way round and how tall is drawn for each place. Wood
/// that is led to one side only points the same way all along a row.
void add_vines(Scene& scene, const WorldConfig& world, const WorldLayout& layout,
               std::uint64_t seed, const CacheFolder& cache) {
  const PlantModels models = add_plants(scene, world, seed, cache);
  const std::vector<VinePlace>& places = layout.vines;
  const bool one_sided = world.vines.training == Training::kUnilateralCordon ||
                         world.vines.training == Training::kSingleGuyot;
  for (std::size_t i = 0; i < places.size(); ++i) {
    RandomSequence random(RandomStream(seed, "vine", i));
    const VineKind kind = vine_at(world, seed, i);
    if (kind == VineKind::kNone) continue;
    const std::vector<int>& choice = kind == VineKind::kYoung ? models.young : models.grown;
    const int model = choice.at(random.below(static_cast<int>(choice.size())));
    const double turn = places[i].heading + (one_sided ? 0 : random.below(2)) * std::numbers::pi;
    const Eigen::Vector2d& foot = places[i].foot;
    const Eigen::Vector3d at(foot.x(), foot.y(), layout.terrain.height(foot));
    const Pose pose{from_roll_pitch_yaw({0, 0, turn}), at};
    const auto scale = static_cast<float>(random.uniform(1.0, kLargestPlantScale));
    scene.instances.push_back({model, pose, scale, static_cast<int>(i)});
  }
}

}  // namespace

Scene build_scene(const WorldConfig& world, std::uint64_t seed, const CacheFolder& cache,
                  bool painted) {
  Scene scene;
  scene.painted = painted;
  scene.seed = seed;
  scene.light = daylight(world.sun, world.sky, usual_overcast(world.vines.bbch));
  scene.wind = make_wind(world.wind, seed);
  const WorldLayout layout = lay_out(world);
  add_vines(scene, world, layout, seed, cache);
  add_trellis(scene, world.trellis, layout, seed);
  add_tags(scene, world, layout);
  add_occluders(scene, world, layout, seed);
  add_ground_cover(scene, world, layout, seed);
  add_ground(scene, world, layout, seed);
  add_backdrop(scene, world, layout.terrain, seed);
  return scene;
}

}  // namespace vinebench::sim
