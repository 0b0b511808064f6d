// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/plants/grapevine_light.h"
#include "sim/plants/grapevine_shape.h"

namespace vinebench::sim {

// Triangle meshes of grapevines; mesh_grapevines combines them.

enum PlantTexture { kBarkTexture, kCaneTexture, kLeafTexture, kBunchTexture, kFoliageTexture };
enum PlantMaterial {
  kTrunkMaterial,
  kCaneMaterial,
  kLeafMaterial,
  kBunchMaterial,
  kFoliageMaterial,
  kLeafCardMaterial,
  kShelterMaterial,
  kPlantMaterials
};

enum class Berries { kSolid, kCaps, kRound };

/// Level of detail of a near plant.
struct MeshDetail {
  double until;   ///< m
  int triangles;  ///< for a metre of row; berries get the remaining budget
  int wood_sides;
  int cane_sides;
  int stride;   ///< points of a path from one ring to the next
  bool stalks;  ///< petioles, tendrils, stalks of bunches
  int leaf;     ///< squares a side of a blade's cut-out image; 0: folded along the midrib
  Berries berries;
};

/// A level of meshes, its occlusion baked.
LevelOfDetail mesh_near(const Grapevine& plant, const MeshDetail& detail, const CanopyLight& light);

/// The level from which far ones are painted: all except the trunk and the grow tube.
std::vector<Primitive> mesh_to_paint(const Grapevine& plant, const CanopyLight& light);

/// Trunk, arms and shelter, in a few triangles; `bunches` of them as solids.
void add_far_wood(LevelOfDetail& level, const Grapevine& plant, int stride, int sides);
void add_far_bunches(LevelOfDetail& level, const Grapevine& plant, int triangles);

/// Views of the plants from both sides and from the row's end, all in one image.
class FarPlants {
 public:
  FarPlants(const std::vector<Grapevine>& plants, const std::vector<Texture>& textures,
            const std::vector<Material>& materials);

  const Texture& texture() const { return texture_; }

  /// Levels for plants from 4.5 m to the horizon: first curved cards, then crossed ones.
  std::vector<LevelOfDetail> levels(std::size_t plant) const;

 private:
  struct Card {
    TextureCell cell;
    Eigen::Vector2f from, to;  ///< m, along x (or y for a slab) and z
    float place = 0;           ///< m, along y (or x for a slab)
    float occlusion = 1;
    std::vector<float> relief;  ///< m along y, kReliefColumns + 1 by kReliefRows + 1, top first
    bool empty = true;
  };
  struct Cards {
    std::array<Card, 2> sides;  ///< the halves of the canopy at -y and +y
    std::array<Card, 2> slabs;  ///< those at -x and +x, seen along the row
  };

  void paint(std::size_t plant, const std::vector<Texture>& textures,
             const std::vector<Material>& materials);
  Card paint_card(const Grapevine& part, const CanopyLight& light, bool slab, float sign,
                  const cv::Rect& cell, const std::vector<Texture>& textures,
                  const std::vector<Material>& materials);
  static void add_side(Primitive& to, const Card& card, float sign, int columns, int rows);
  static void add_slab(Primitive& to, const Card& card);

  const std::vector<Grapevine>& plants_;
  std::vector<Cards> cards_;
  Texture texture_;
};

}  // namespace vinebench::sim
