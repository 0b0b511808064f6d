// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/util/random.h"
#include "sim/assets/asset.h"
#include "sim/plants/grapevine_stage.h"
#include "sim/plants/plant_textures.h"
#include "sim/scene/mesh_builder.h"
#include "sim/textures/textures.h"
#include "sim/vineyard/ground.h"
#include "sim/world/row_index.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

enum CoverMaterial { kBlade, kPebble, kFallenLeaf, kSward, kCoverMaterials };

/// A patch of ground as it is strewn: half-extents in m, and how much of everything.
struct PatchSpec {
  const char* name;
  float half_x, half_y;
  int tufts, blades;
  float low, high;  ///< height of grass, m
  int pebbles;
  int fallen_leaves;
  int along, across;  ///< cards of standing blades, for all but the nearest patches
};

enum PatchKind { kWeeds, kLitter, kGrass, kMown, kFringe };

constexpr std::array<PatchSpec, 5> kPatches{{
    {"weeds", 0.50f, 0.13f, 11, 12, 0.04f, 0.17f, 8, 4, 2, 2},
    {"litter", 0.50f, 0.50f, 7, 7, 0.015f, 0.05f, 16, 9, 1, 1},
    {"grass", 0.50f, 0.50f, 20, 12, 0.05f, 0.16f, 5, 2, 2, 2},
    {"mown", 0.50f, 0.38f, 26, 10, 0.025f, 0.07f, 0, 3, 1, 2},
    {"fringe", 0.50f, 0.10f, 10, 11, 0.03f, 0.10f, 4, 3, 1, 1},
}};
constexpr int kVariants = 6;
constexpr double kFullUntil = 2.5, kThinUntil = 13, kCardsUntil = 70;  // m

void add_blade(MeshBuilder& builder, const Vector3f& root, float height, float turn, float bend,
               bool fine) {
  const Vector3f lean(std::cos(turn), std::sin(turn), 0);
  const Vector3f across = Vector3f(-lean.y(), lean.x(), 0) * (0.10f * std::sqrt(height) * 0.11f);
  const Vector3f middle = root + 0.6f * height * Vector3f::UnitZ() + 0.3f * bend * height * lean;
  const Vector3f tip = root + (1 - 0.3f * bend) * height * Vector3f::UnitZ() + bend * height * lean;
  const Vector3f normal = (Vector3f::UnitZ() + 0.5f * lean).normalized();
  const std::uint32_t a = builder.vertex(root - across, normal, {0, 1}, 0.45f);
  const std::uint32_t b = builder.vertex(root + across, normal, {1, 1}, 0.45f);
  const std::uint32_t t = builder.vertex(tip, normal, {0.5f, 0});
  if (!fine) return builder.triangle(a, b, t);
  const std::uint32_t c = builder.vertex(middle + 0.8f * across, normal, {1, 0.5f}, 0.9f);
  const std::uint32_t d = builder.vertex(middle - 0.8f * across, normal, {0, 0.5f}, 0.9f);
  builder.quad(a, b, c, d);
  builder.triangle(d, c, t);
}

class Patch {
 public:
  Patch(const PatchSpec& spec, std::uint64_t seed, int variant, bool fine)
      : spec_(spec), fine_(fine), random_(RandomStream(seed, spec.name, variant)) {
    for (int m = 0; m < kCoverMaterials; ++m) parts_.at(m).material = m;
  }

  std::vector<Primitive> strew() {
    for (int i = 0; i < spec_.tufts; ++i) grow_tuft();
    for (int i = 0; i < spec_.pebbles; ++i) drop_pebble();
    for (int i = 0; i < spec_.fallen_leaves; ++i) drop_leaf();
    return finish();
  }

  /// The standing blades alone: the ground's texture has the rest.
  std::vector<Primitive> strew_far() {
    stand_cards();
    return finish();
  }

 private:
  std::vector<Primitive> finish() {
    std::vector<Primitive> kept;
    for (Primitive& part : parts_) {
      if (!part.indices.empty()) kept.push_back(std::move(part));
    }
    return kept;
  }

  float uniform(float low, float high) { return static_cast<float>(random_.uniform(low, high)); }
  Vector3f somewhere() {
    const float x = uniform(-spec_.half_x, spec_.half_x);
    return {x, uniform(-spec_.half_y, spec_.half_y), 0};
  }

  void grow_tuft() {
    MeshBuilder builder(parts_[kBlade]);
    const Vector3f middle = somewhere();
    const float height = uniform(spec_.low, spec_.high);
    for (int i = 0; i < spec_.blades; ++i) {
      const float turn = uniform(0, 6.2832f), out = uniform(0, 0.4f * height);
      const float tall = height * uniform(0.5f, 1.0f), bend = uniform(0.2f, 0.9f);
      const Vector3f root = middle + out * Vector3f(std::cos(turn), std::sin(turn), 0);
      if (fine_ || i % 3 == 0) add_blade(builder, root, tall, turn, bend, fine_);
    }
  }

  /// Within the bounds of what lies and grows in the patch.
  void stand_cards() {
    const float half_x = 0.88f * spec_.half_x, half_y = 0.88f * spec_.half_y;
    for (int i = 0; i < spec_.along; ++i) {
      const float y = half_y * (2 * (static_cast<float>(i) + 0.5f) / spec_.along - 1);
      stand_card({0, y, 0}, {half_x, 0.9f / spec_.along * half_y * uniform(-1, 1), 0});
    }
    for (int i = 0; i < spec_.across; ++i) {
      const float x = half_x * (2 * (static_cast<float>(i) + 0.5f) / spec_.across - 1);
      stand_card({x + uniform(-0.05f, 0.05f), 0, 0}, {uniform(-0.2f, 0.2f), half_y, 0});
    }
  }

  /// As bright as the ground that it stands on, darker at its foot.
  void stand_card(const Vector3f& middle, const Vector3f& half) {
    MeshBuilder builder(parts_[kSward]);
    const float from = uniform(0, 1),
                to = from + 2 * half.norm() / static_cast<float>(kSwardLength);
    const Vector3f up = 0.85f * spec_.high * Vector3f::UnitZ();
    const Vector3f normal = Vector3f::UnitZ();
    const std::uint32_t a = builder.vertex(middle - half, normal, {from, 0.98f}, 0.55f);
    const std::uint32_t b = builder.vertex(middle + half, normal, {to, 0.98f}, 0.55f);
    const std::uint32_t c = builder.vertex(middle + half + up, normal, {to, 0.02f});
    const std::uint32_t d = builder.vertex(middle - half + up, normal, {from, 0.02f});
    builder.quad(a, b, c, d);
  }

  void drop_pebble() {
    MeshBuilder builder(parts_[kPebble]);
    const float size = 0.006f + 0.022f * std::pow(uniform(0, 1), 3.0f);
    const Vector3f at = somewhere() - 0.2f * size * Vector3f::UnitZ();
    const Vector3f up(uniform(-0.3f, 0.3f), uniform(-0.3f, 0.3f), 1);
    const std::size_t first = parts_[kPebble].vertices.size();
    if (!fine_ && size < 0.012f) return;
    builder.dome(at, size, up, 6, fine_ ? 2 : 1);
    for (std::size_t i = first; i < parts_[kPebble].vertices.size(); ++i) {
      Vertex& vertex = parts_[kPebble].vertices[i];
      vertex.position.z() = at.z() + 0.7f * (vertex.position.z() - at.z());  // stones lie flat
      vertex.uv += Eigen::Vector2f(at.x(), at.y());
    }
  }

  void drop_leaf() {
    BladePlacement leaf;
    leaf.foot = somewhere();
    leaf.size = uniform(0.04f, 0.075f);
    leaf.curl = -uniform(0.05f, 0.3f);  // the rim stands up as it dries
    const float turn = uniform(0, 6.2832f);
    leaf.axes = axes_along(Vector3f(uniform(-0.15f, 0.15f), uniform(-0.15f, 0.15f), 1),
                           {std::cos(turn), std::sin(turn), 0});
    leaf.foot.z() = 0.2f * leaf.size;
    leaf.shading_normal = Vector3f::Zero();
    leaf.cell = leaf_cell(random_.below(kLeafVariants), random_.below(kLeafPrints));
    MeshBuilder(parts_[kFallenLeaf]).blade(leaf, fine_ ? 1 : 0);
  }

  const PatchSpec& spec_;
  bool fine_;
  RandomSequence random_;
  std::array<Primitive, kCoverMaterials> parts_;
};

int add_patch(Scene& scene, const PatchSpec& spec, std::uint64_t seed, int variant,
              const std::vector<Texture>& textures) {
  Asset asset;
  asset.textures = textures;
  asset.add(make_material("grass", Label::kGrass, 0));
  asset.materials.back().double_sided = true;
  asset.materials.back().translucency = 0.3f;
  asset.add(make_material("stone", Label::kGround, 1));
  asset.add(make_material("fallen leaf", Label::kGround, 2));
  asset.materials.back().double_sided = true;
  asset.materials.back().colour = {0.95f, 0.42f, 0.28f};  // turns the green of the atlas brown
  asset.add(make_material("sward", Label::kGrass, 3));
  asset.materials.back().double_sided = true;
  asset.materials.back().cutout = true;
  asset.materials.back().colour.setConstant(0.85f);  // blades shade each other
  asset.model.name = spec.name;
  asset.model.levels.push_back({kFullUntil, Patch(spec, seed, variant, true).strew()});
  asset.model.levels.push_back({kThinUntil, Patch(spec, seed, variant, false).strew()});
  asset.model.levels.push_back({kCardsUntil, Patch(spec, seed, variant, false).strew_far()});
  asset.model.levels.push_back({1e9, {}});
  asset.update_bounds();
  return add_asset(scene, std::move(asset));
}

class Strewer {
 public:
  Strewer(Scene& scene, const WorldConfig& world, const WorldLayout& layout, std::uint64_t seed)
      : scene_(scene),
        world_(world),
        layout_(layout),
        terrain_(layout.terrain),
        rows_(layout.rows),
        random_(RandomStream(seed, "ground cover")) {
    const double withered = withered_share(world.vines.bbch);
    const std::vector<Texture> textures{
        grass_texture(seed, withered), stone_texture(seed),
        painted_texture(scene, "leaf", [&] { return leaf_texture(seed); }),
        painted_texture(scene, "sward", [&] { return sward_texture(seed, withered); })};
    for (std::size_t kind = 0; kind < kPatches.size(); ++kind) {
      for (int v = 0; v < kVariants; ++v) {
        models_[kind][v] = add_patch(scene, kPatches[kind], seed, v, textures);
      }
    }
  }

  /// Weeds under the vines, some places bare.
  void strew_rows() {
    for (const RowConfig& row : layout_.rows) {
      const Eigen::Vector2d along = (row.end - row.start).normalized();
      for (double s = 0.5; s < (row.end - row.start).norm(); s += 1) {
        put(kWeeds, row.start + s * along, std::atan2(along.y(), along.x()));
      }
    }
  }

  /// Mown grass between the wheel tracks, longer at the edge of the bare strips.
  void strew_aisles() {
    const RowFrame& frame = terrain_.frame();
    const double edge = world_.ground.bare_strip / 2;
    for (double s = 0.5; s < frame.rows.sizes().x(); s += 1) {
      for (double t = 0; t <= frame.rows.sizes().y() + frame.spacing / 2; t += frame.spacing) {
        for (const double side : {-1.0, 1.0}) put_in_frame(kFringe, s, t + side * (edge + 0.06));
        if (t > 0) put_in_frame(kMown, s, t - frame.spacing / 2);
      }
    }
  }

  /// Longer grass where the aisles end and the headland begins: mowers turn there.
  void strew_ends() {
    const Eigen::Vector2d size = terrain_.frame().rows.sizes();
    const double beyond = terrain_.frame().spacing / 2;
    for (double t = -beyond; t <= size.y() + beyond; t += 0.5) {
      for (const double s : {-kRowEnd, size.x() + kRowEnd}) {
        put_in_frame(kWeeds, s + random_.uniform(-0.15, 0.15), t, std::numbers::pi / 2);
      }
    }
  }

  /// What fills the rest, patch beside patch.
  void strew_field() {
    const RowFrame& frame = terrain_.frame();
    const bool grass = world_.ground.aisles == WorldConfig::Ground::Aisles::kGrass;
    const double margin = grass ? std::min(world_.terrain.margin, kMostMargin) : 4;  // m
    const Eigen::Vector2d size = frame.rows.sizes();
    const Eigen::Vector2d inner(grass ? kRowEnd + 0.5 : -1e9, frame.spacing / 2 + 0.4);
    for (double t = -margin; t < size.y() + margin; t += 1) {
      for (double s = -margin; s < size.x() + margin; s += 1) {
        const bool in_aisles = s > -inner.x() && s < size.x() + inner.x() && t > -inner.y() &&
                               t < size.y() + inner.y();
        if (grass && in_aisles) continue;
        const Eigen::Vector2d at = frame.to_world(frame.rows.min() + Eigen::Vector2d(s, t));
        put(rows_.distance(at) < 1.2 && !grass ? kLitter : kGrass, at, frame.heading());
      }
    }
  }

 private:
  void put_in_frame(PatchKind kind, double s, double t, double turn = 0) {
    const RowFrame& frame = terrain_.frame();
    put(kind, frame.to_world(frame.rows.min() + Eigen::Vector2d(s, t)), frame.heading() + turn);
  }

  void put(PatchKind kind, const Eigen::Vector2d& at, double yaw) {
    const bool square = kPatches[kind].half_x == kPatches[kind].half_y;
    const double turn =
        square ? random_.below(4) * std::numbers::pi / 2 : random_.below(2) * std::numbers::pi;
    const int model = models_[kind][random_.below(kVariants)];
    if (((at - terrain_.frame().middle()).cwiseAbs().array() > world_.ground_size / 2 - 1).any()) {
      return;
    }
    scene_.instances.push_back({model, terrain_.lie(at, yaw + turn, kReach), 1, id_++});
  }

  static constexpr double kMostMargin = 8;  // m of grass round the rows
  static constexpr double kReach = 0.35;    // m, over which a patch leans with the ground
  Scene& scene_;
  const WorldConfig& world_;
  const WorldLayout& layout_;
  const Terrain& terrain_;
  RowIndex rows_;
  RandomSequence random_;
  std::array<std::array<int, kVariants>, kPatches.size()> models_{};
  int id_ = 0;
};

}  // namespace

void add_ground_cover(Scene& scene, const WorldConfig& world, const WorldLayout& layout,
                      std::uint64_t seed) {
  Strewer strewer(scene, world, layout, seed);
  strewer.strew_rows();
  if (world.ground.aisles == WorldConfig::Ground::Aisles::kGrass) {
    strewer.strew_aisles();
    strewer.strew_ends();
  }
  strewer.strew_field();
}

}  // namespace vinebench::sim
