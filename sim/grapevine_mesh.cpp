// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/grapevine.h"
#include "sim/textures.h"
#include "slam/base/random.h"

namespace vinebench {
namespace {

using Eigen::Vector3f;

enum TextureIndex {
  kBarkTexture,
  kCaneTexture,
  kLeafTexture,
  kFoliageTexture,
  kBerryTexture,
  kBunchTexture
};
enum MaterialIndex { kBark, kCane, kLeafBlade, kFoliage, kBerry, kBunchSkin, kMaterials };

struct LevelSpec {
  double until;  ///< m
  int wood_sides;
  int cane_sides;   ///< 0 leaves canes out
  int cane_stride;  ///< points of the path from one ring to the next
  bool stalks;
  int leaf_detail;  ///< -1: clumps of leaves on cards
  int berry_rings;  ///< 0: the bunch is one solid
};

constexpr std::array<LevelSpec, 4> kLevels{{
    {0.9, 9, 4, 1, true, 2, 2},
    {2.0, 7, 3, 1, false, 1, 1},
    {4.5, 5, 3, 2, false, 0, 0},
    {1e9, 4, 0, 1, false, -1, 0},
}};

/// How much of the sky's light reaches a point between the leaves (Beer-Lambert through a grid of
/// leaf density).
class CanopyLight {
 public:
  explicit CanopyLight(const std::vector<BladePlacement>& leaves) {
    if (leaves.empty()) return;
    for (const BladePlacement& leaf : leaves) box_.extend(leaf.foot);
    box_.min().array() -= 0.1f;
    box_.max().array() += 0.1f;
    size_ = (box_.sizes() / kCell).array().ceil().cast<int>();
    density_.assign(static_cast<std::size_t>(size_.prod()), 0);
    for (const BladePlacement& leaf : leaves) {
      const Vector3f middle = leaf.foot + 0.4f * leaf.size * leaf.axes.y;
      constexpr float kAreaOfSquare = 1.3f, kSplat = 2.0f;  // spread over the neighbours
      for (const float dx : {-0.02f, 0.02f}) {
        for (const float dz : {-0.02f, 0.02f}) {
          if (float* cell = find(middle + Vector3f(dx, 0, dz))) {
            *cell += kAreaOfSquare / kSplat * leaf.size * leaf.size / 4 / (kCell * kCell * kCell);
          }
        }
      }
    }
  }

  float at(const Vector3f& point) const {
    if (density_.empty()) return 1;
    float light = 0, weight = 0;
    for (const Vector3f& direction : kDirections) {
      const float share = 0.5f + 0.5f * direction.z();
      light += share * std::exp(-0.5f * leaf_area_along(point, direction));
      weight += share;
    }
    return std::clamp(0.12f + 0.88f * light / weight, 0.0f, 1.0f);
  }

 private:
  static constexpr float kCell = 0.05f;  // m
  static inline const std::array<Vector3f, 7> kDirections{
      Vector3f(0, 0, 1),         Vector3f(0, 0.8f, 0.6f),  Vector3f(0, -0.8f, 0.6f),
      Vector3f(0.8f, 0, 0.6f),   Vector3f(-0.8f, 0, 0.6f), Vector3f(0, 0.98f, -0.2f),
      Vector3f(0, -0.98f, -0.2f)};

  float* find(const Vector3f& point) {
    return const_cast<float*>(static_cast<const CanopyLight*>(this)->find(point));
  }
  const float* find(const Vector3f& point) const {
    const Eigen::Vector3i cell = ((point - box_.min()) / kCell).array().floor().cast<int>();
    if ((cell.array() < 0).any() || (cell.array() >= size_.array()).any()) return nullptr;
    return &density_[static_cast<std::size_t>((cell.z() * size_.y() + cell.y()) * size_.x() +
                                              cell.x())];
  }

  /// Leaf area per area across the ray, up to 0.4 m away.
  float leaf_area_along(const Vector3f& from, const Vector3f& direction) const {
    float area = 0;
    for (int step = 1; step <= 8; ++step) {
      if (const float* cell = find(from + (step * kCell) * direction)) area += *cell * kCell;
    }
    return area;
  }

  Eigen::AlignedBox3f box_;
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  std::vector<float> density_;
};

Tube thinned(const Tube& tube, int stride) {
  Tube thin;
  for (std::size_t i = 0; i + 1 < tube.path.size(); i += static_cast<std::size_t>(stride)) {
    thin.path.push_back(tube.path[i]);
    thin.radii.push_back(tube.radii[i]);
  }
  thin.path.push_back(tube.path.back());
  thin.radii.push_back(tube.radii.back());
  return thin;
}

/// Half-width of a bunch at `down` (0 top, 1 bottom), in its radii.
float bunch_profile(float down) {
  constexpr std::array<float, 6> kWidth{0.50f, 0.95f, 1.0f, 0.86f, 0.62f, 0.25f};
  const float at = std::clamp(down, 0.0f, 1.0f) * (kWidth.size() - 1);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), kWidth.size() - 2);
  return kWidth[i] + (at - static_cast<float>(i)) * (kWidth[i + 1] - kWidth[i]);
}

/// Berries round the core by the golden angle, the last one at the very bottom.
void add_berries(MeshBuilder& builder, const Bunch& bunch, int rings) {
  constexpr int kBerries = 36;
  RandomSequence random(RandomStream(bunch.berry_seed, "berries"));
  for (int i = 0; i < kBerries; ++i) {
    const float radius = static_cast<float>(random.uniform(0.0072, 0.0090));
    const float down = (static_cast<float>(i) + 0.5f) / kBerries;
    const float turn = 2.39996f * i + static_cast<float>(random.uniform(-0.3, 0.3));
    const float out = std::max(0.0f, bunch.radius * bunch_profile(down) - radius);
    const float z = radius + (bunch.length - 2 * radius) * (1 - down);
    const bool last = i + 1 == kBerries;
    const Vector3f centre = bunch.top + Vector3f(out * std::cos(turn), out * std::sin(turn),
                                                 (last ? radius : z) - bunch.length);
    const Vector3f outward(std::cos(turn), std::sin(turn), last ? -1.0f : 0.5f - down);
    builder.dome(centre, radius, outward, rings > 1 ? 5 : 6, rings);
  }
}

std::vector<float> bunch_radii(const Bunch& bunch, int rings, float share) {
  std::vector<float> radii;
  for (int i = 0; i <= rings; ++i) {
    radii.push_back(share * bunch.radius * bunch_profile(static_cast<float>(i) / rings));
  }
  return radii;
}

class Mesher {
 public:
  Mesher(const Grapevine& plant, const LevelSpec& spec) : plant_(plant), spec_(spec) {
    for (int m = 0; m < kMaterials; ++m) parts_.at(m).material = m;
  }

  LevelOfDetail mesh(const CanopyLight& light) {
    add_wood();
    spec_.leaf_detail < 0 ? add_clumps() : add_leaves();
    add_bunches();
    LevelOfDetail level{spec_.until, {}};
    for (Primitive& part : parts_) {
      if (part.indices.empty()) continue;
      for (Vertex& vertex : part.vertices) {
        vertex.position.y() =
            std::clamp(vertex.position.y(), -plant_.half_depth, plant_.half_depth);
        vertex.occlusion = light.at(vertex.position);
      }
      level.primitives.push_back(std::move(part));
    }
    return level;
  }

 private:
  void add_wood() {
    MeshBuilder bark(parts_[kBark]), cane(parts_[kCane]);
    const bool coarse = spec_.cane_sides == 0;
    for (const Tube& tube : plant_.wood) {
      bark.tube(thinned(tube, coarse ? 4 : spec_.cane_stride), spec_.wood_sides, 4, !coarse);
    }
    for (const Tube& tube : plant_.canes) {
      if (!coarse) cane.tube(thinned(tube, spec_.cane_stride), spec_.cane_sides, 6, false);
    }
    for (const Tube& tube : plant_.stalks) {
      if (spec_.stalks) cane.tube(tube, 3, 6, false);
    }
  }

  void add_leaves() {
    MeshBuilder builder(parts_[kLeafBlade]);
    for (const BladePlacement& leaf : plant_.leaves) builder.blade(leaf, spec_.leaf_detail);
  }

  /// A card in place of every third leaf, turned towards the aisle.
  void add_clumps() {
    MeshBuilder builder(parts_[kFoliage]);
    for (std::size_t i = 0; i < plant_.leaves.size(); i += 3) {
      BladePlacement clump = plant_.leaves[i];
      const float swing = 1.0f * std::sin(static_cast<float>(i) * 1.7f);
      const float side = clump.foot.y() < 0 ? -1.0f : 1.0f;
      const Axes axes =
          axes_along({std::sin(swing), side * std::cos(swing), 0.2f}, Vector3f::UnitZ());
      clump.axes = {-axes.y, axes.x, axes.z};
      clump.size = 0.19f;
      clump.foot.z() -= 0.03f;
      clump.foot.y() *= 0.7f;
      clump.cell = foliage_cell(static_cast<int>(i / 3) % kFoliageVariants);
      builder.card(clump);
    }
  }

  void add_bunches() {
    MeshBuilder skin(parts_[kBunchSkin]), berry(parts_[kBerry]);
    const bool far = spec_.leaf_detail < 0;
    for (const Bunch& bunch : plant_.bunches) {
      if (spec_.berry_rings > 0) {
        skin.spindle(bunch.top, bunch.length - 0.01f, bunch_radii(bunch, 3, 0.72f), 5, 1);
        add_berries(berry, bunch, spec_.berry_rings);
      } else {
        skin.spindle(bunch.top, bunch.length, bunch_radii(bunch, far ? 2 : 4, 1), far ? 4 : 6, 1);
      }
    }
  }

  const Grapevine& plant_;
  const LevelSpec& spec_;
  std::array<Primitive, kMaterials> parts_;
};

void add_materials(Asset& asset) {
  asset.add(make_material("bark", Label::kTrunk, kBarkTexture));
  asset.add(make_material("cane", Label::kCane, kCaneTexture));
  Material leaf = make_material("leaf", Label::kLeaf, kLeafTexture);
  leaf.double_sided = true;
  leaf.translucency = 0.35f;
  asset.add(leaf);
  Material foliage = leaf;
  foliage.name = "foliage";
  foliage.texture = kFoliageTexture;
  foliage.cutout = true;
  asset.add(foliage);
  asset.add(make_material("berry", Label::kBunch, kBerryTexture));
  asset.add(make_material("bunch", Label::kBunch, kBunchTexture));
}

}  // namespace

std::vector<Texture> plant_textures(std::uint64_t seed) {
  Texture leaves = leaf_texture(seed);
  Texture foliage = foliage_texture(seed, leaves);
  return {bark_texture(seed), cane_texture(seed),  std::move(leaves),
          std::move(foliage), berry_texture(seed), bunch_texture(seed)};
}

Asset mesh_grapevine(const Grapevine& plant, std::vector<Texture> textures) {
  Asset asset;
  asset.textures = std::move(textures);
  add_materials(asset);
  asset.model.name = "grapevine";
  const CanopyLight light(plant.leaves);
  for (const LevelSpec& spec : kLevels)
    asset.model.levels.push_back(Mesher(plant, spec).mesh(light));
  asset.update_bounds();
  return asset;
}

}  // namespace vinebench
