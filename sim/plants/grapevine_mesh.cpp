// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/plants/grapevine_mesh.h"

#include <algorithm>
#include <cmath>

#include "sim/plants/grapevine_bunch.h"
#include "sim/plants/plant_textures.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr float kSmallLeaf = 0.082f;                   // m; shorter ones are coarser in near levels
constexpr float kShootFrom = 0.02f, kShootTo = 0.48f;  // u of the image of canes
constexpr float kCaneFrom = 0.52f, kCaneTo = 0.98f;
constexpr float kShelterGrain = 0.1f;      // v a metre
constexpr float kPaintedRadius = 0.0045f;  // m, of canes on cards

Tube thinned(const Tube& tube, int stride) {
  Tube thin;
  thin.knots = tube.knots;
  for (std::size_t i = 0; i + 1 < tube.path.size(); i += static_cast<std::size_t>(stride)) {
    thin.path.push_back(tube.path[i]);
    thin.radii.push_back(tube.radii[i]);
  }
  thin.path.push_back(tube.path.back());
  thin.radii.push_back(tube.radii.back());
  return thin;
}

/// Nowhere thinner than that: a card's texels break finer lines up.
Tube broadened(Tube tube, float radius) {
  for (float& r : tube.radii) r = std::max(r, radius);
  return tube;
}

/// The parts of one level, a primitive a material.
class Parts {
 public:
  Parts() {
    for (int m = 0; m < kPlantMaterials; ++m) at(m).material = m;
  }
  Primitive& at(int material) { return parts_.at(static_cast<std::size_t>(material)); }

  int triangles() const {
    std::size_t indices = 0;
    for (const Primitive& part : parts_) indices += part.indices.size();
    return static_cast<int>(indices / 3);
  }

  std::vector<Primitive> finish(const Grapevine& plant, const CanopyLight& light) {
    std::vector<Primitive> all;
    for (Primitive& part : parts_) {
      if (part.indices.empty()) continue;
      for (Vertex& vertex : part.vertices) {
        vertex.position.y() = std::clamp(vertex.position.y(), -plant.half_depth, plant.half_depth);
        vertex.occlusion *= light.at(vertex.position);
      }
      all.push_back(std::move(part));
    }
    return all;
  }

 private:
  std::array<Primitive, kPlantMaterials> parts_;
};

void add_wood(Parts& parts, const Grapevine& plant, const MeshDetail& detail) {
  MeshBuilder trunk(parts.at(kTrunkMaterial)), cane(parts.at(kCaneMaterial));
  for (const Tube& tube : plant.wood) {
    trunk.tube(thinned(tube, detail.stride), detail.wood_sides, 4, true);
  }
  for (const Tube& tube : plant.canes) {
    cane.tube(thinned(tube, detail.stride), detail.cane_sides, 6, detail.stalks, kCaneFrom,
              kCaneTo);
  }
  if (plant.shelter) {
    MeshBuilder(parts.at(kShelterMaterial))
        .tube(*plant.shelter, detail.wood_sides, kShelterGrain, false);
  }
}

void add_shoots(Parts& parts, const Grapevine& plant, const MeshDetail& detail) {
  MeshBuilder cane(parts.at(kCaneMaterial));
  for (const Tube& tube : plant.shoots) {
    cane.tube(thinned(tube, detail.stride), detail.cane_sides, 6, false, kShootFrom, kShootTo);
  }
  if (!detail.stalks) return;
  for (const Tube& tube : plant.stalks) cane.tube(tube, 3, 6, false, kShootFrom, kShootTo);
  for (const Petiole& petiole : plant.petioles) {
    cane.spike(petiole.from, petiole.to, petiole.radius, {0.3f, 3 * petiole.from.z()});
  }
}

void add_leaves(Parts& parts, const Grapevine& plant, int cells) {
  MeshBuilder builder(parts.at(kLeafCardMaterial));
  for (const BladePlacement& leaf : plant.leaves) {
    builder.card(leaf, leaf.size < kSmallLeaf ? std::min(cells, 2) : cells);
  }
}

/// As polygons, for painting.
void add_blades(Parts& parts, const Grapevine& plant) {
  MeshBuilder builder(parts.at(kLeafMaterial));
  for (const BladePlacement& leaf : plant.leaves) builder.blade(leaf, 1);
}

void add_bunches(Parts& parts, const Grapevine& plant, const MeshDetail& detail) {
  if (plant.bunches.empty()) return;
  BunchDetail look;
  look.fine = detail.berries == Berries::kRound;
  look.sides = detail.berries == Berries::kSolid ? 6 : 7;
  if (detail.berries != Berries::kSolid) {
    int cores = 0;
    for (const Bunch& bunch : plant.bunches) {
      cores += look.solid_triangles() * (bunch.wing.isZero() ? 1 : 2);
    }
    const float widths = std::max(1.0f, 2 * plant.half_share);
    const int left =
        static_cast<int>(static_cast<float>(detail.triangles) * widths) - parts.triangles() - cores;
    look.triangles = std::max(60, left / static_cast<int>(plant.bunches.size()));
  }
  int part = 0;
  for (const Bunch& bunch : plant.bunches) {
    add_bunch(parts.at(kBunchMaterial), bunch, ++part, look);
  }
}

}  // namespace

LevelOfDetail mesh_near(const Grapevine& plant, const MeshDetail& detail,
                        const CanopyLight& light) {
  Parts parts;
  add_wood(parts, plant, detail);
  add_shoots(parts, plant, detail);
  add_leaves(parts, plant, detail.leaf);
  add_bunches(parts, plant, detail);
  return {detail.until, parts.finish(plant, light)};
}

std::vector<Primitive> mesh_to_paint(const Grapevine& plant, const CanopyLight& light) {
  constexpr MeshDetail kPainted{0, 6000, 5, 3, 1, false, 0, Berries::kCaps};
  Parts parts;
  add_shoots(parts, plant, kPainted);
  add_blades(parts, plant);
  add_bunches(parts, plant, kPainted);
  MeshBuilder arms(parts.at(kTrunkMaterial)), cane(parts.at(kCaneMaterial));
  for (std::size_t i = 1; i < plant.wood.size(); ++i) arms.tube(plant.wood[i], 5, 4, true);
  for (const Tube& tube : plant.canes) {
    cane.tube(broadened(tube, kPaintedRadius), 3, 6, false, kCaneFrom, kCaneTo);
  }
  return parts.finish(plant, light);
}

void add_far_wood(LevelOfDetail& level, const Grapevine& plant, int stride, int sides) {
  Parts parts;
  MeshBuilder trunk(parts.at(kTrunkMaterial));
  if (sides == 0 && plant.shelter) {
    // Its tube hides the stem.
  } else if (sides == 0) {  // a spike as wide as the middle of the trunk
    const Tube& tube = plant.wood.front();
    const Vector3f up = tube.path.back() - tube.path.front();
    trunk.spike(tube.path.front(), tube.path.front() + 1.6f * up,
                1.5f * tube.radii[tube.radii.size() / 2], {0.5f, 0});
  } else {
    for (const Tube& tube : plant.wood) trunk.tube(thinned(tube, stride), sides, 4, false);
  }
  if (plant.shelter) {
    MeshBuilder(parts.at(kShelterMaterial))
        .tube(thinned(*plant.shelter, 2), 3, kShelterGrain, false);
  }
  for (Primitive& part : parts.finish(plant, CanopyLight(plant.leaves))) {
    level.primitives.push_back(std::move(part));
  }
}

void add_far_bunches(LevelOfDetail& level, const Grapevine& plant, int triangles) {
  constexpr BunchDetail kSolid{0, false, 3, true};
  constexpr int kEach = kSolid.solid_triangles();
  Parts parts;
  for (std::size_t i = 0; i < plant.bunches.size() && parts.triangles() + kEach <= triangles; ++i) {
    Bunch bunch = plant.bunches[i];
    bunch.wing.setZero();
    bunch.radius *= 1.2f;  // compensates for three sides instead of a circle
    add_bunch(parts.at(kBunchMaterial), bunch, static_cast<int>(i) + 1, kSolid);
  }
  for (Primitive& part : parts.finish(plant, CanopyLight(plant.leaves))) {
    level.primitives.push_back(std::move(part));
  }
}

}  // namespace vinebench::sim
