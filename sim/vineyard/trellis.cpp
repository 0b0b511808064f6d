// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/trellis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/util/random.h"
#include "sim/assets/asset.h"
#include "sim/scene/mesh_builder.h"
#include "sim/textures/textures.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Brackets = WorldConfig::Trellis::Brace;

constexpr float kWireRadius = 0.0012f;  // m
constexpr float kDripRadius = 0.008f;   // m
constexpr double kClips = 1.0;          // m between the drip line's clips
constexpr int kDripPieces = 4;          // straight pieces between two clips
constexpr double kBuried = 0.08;        // m of a post below the ground, against gaps on a slope
constexpr double kStrutRadius = 0.03;   // m
constexpr double kBraceReach = 0.65;    // of the post's height, foot to foot
constexpr double kStrutHead = 0.75;     // of the post's height
constexpr double kAnchorHead = 0.94;

Vector3d above(const Terrain& terrain, const TrellisPost& post, double height) {
  const Eigen::Vector2d at = post.at(height);
  return {at.x(), at.y(), terrain.height(post.foot) + height};
}

LevelOfDetail post_level(float length, float radius, double until, int sides) {
  Primitive primitive;
  const auto buried = static_cast<float>(-kBuried);
  MeshBuilder(primitive).tube(
      {{{0, 0, buried}, {0, 0, length / 2}, {0, 0, length}}, {radius, radius, radius}}, sides, 1.5f,
      true);
  for (Vertex& vertex : primitive.vertices) {
    if (vertex.position.z() < 0) vertex.occlusion = 0.4f;
  }
  return {until, {primitive}};
}

int add_stake(Scene& scene, const char* name, double length, double radius, std::uint64_t seed) {
  Asset stake;
  stake.add(wood_texture(seed));
  stake.add(make_material("post", Label::kPost, 0));
  stake.model.name = name;
  const auto l = static_cast<float>(length), r = static_cast<float>(radius);
  stake.model.levels = {post_level(l, r, 4, 12), post_level(l, r, 1e9, 6)};
  stake.update_bounds();
  return add_asset(scene, std::move(stake));
}

/// A stake from `foot` along `up`, with a rotation about its axis.
Pose stake_pose(const Vector3d& foot, const Vector3d& up, double turn) {
  const Eigen::Quaterniond lean = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up);
  return {(lean * from_roll_pitch_yaw({0, 0, turn})).normalized(), foot};
}

void add_posts(Scene& scene, const WorldConfig::Trellis& trellis, const WorldLayout& layout,
               std::uint64_t seed) {
  const double lean = std::tan(trellis.end_lean_deg * std::numbers::pi / 180);
  const int line = add_stake(scene, "post", trellis.post_height, trellis.post_radius, seed);
  const int end = add_stake(scene, "end post", trellis.post_height * std::sqrt(1 + lean * lean),
                            trellis.end_post_radius, seed);
  const RandomStream random(seed, "posts");
  int id = 0;
  for (const TrellisPost& post : layout.posts) {
    const double turn = random.uniform(static_cast<std::uint64_t>(id), 0, 2 * std::numbers::pi);
    const Vector3d up(post.lean.x(), post.lean.y(), 1);
    const Pose pose = stake_pose(above(layout.terrain, post, 0), up, turn);
    scene.instances.push_back({post.end ? end : line, pose, 1, id++});
  }
  if (trellis.end_brace != Brackets::kStrut) return;
  for (const Brace& brace : trellis_braces(trellis, layout)) {
    const Vector3d way = brace.head - brace.foot;
    const int strut = add_stake(scene, "strut", way.norm(), brace.radius, seed);
    scene.instances.push_back({strut, stake_pose(brace.foot, way, 0), 1, id++});
  }
}

int add_line_material(Scene& scene, const char* name, const Vector3f& colour) {
  scene.materials.push_back(make_material(name, Label::kWire, -1));
  scene.materials.back().colour = colour;
  return static_cast<int>(scene.materials.size()) - 1;
}

/// A tube that sags between its clips.
void add_drip_span(Scene& scene, const Vector3d& from, const Vector3d& to, double sag,
                   int material) {
  const Vector3d way = to - from;
  const int clips = std::max(1, static_cast<int>(std::round(way.norm() / kClips)));
  const int pieces = clips * kDripPieces;
  const auto at = [&](int i) {
    const double between = static_cast<double>(i % kDripPieces) / kDripPieces;
    const Vector3d hung =
        from + way * i / pieces - 4 * sag * between * (1 - between) * Vector3d::UnitZ();
    return Vector3f(hung.cast<float>());
  };
  for (int i = 0; i < pieces; ++i) {
    scene.wires.push_back({at(i), at(i + 1), kDripRadius, material});
  }
}

void add_wires(Scene& scene, const WorldConfig::Trellis& trellis, const WorldLayout& layout) {
  const int steel = add_line_material(scene, "wire", {0.30f, 0.31f, 0.32f});
  const std::vector<TrellisPost>& posts = layout.posts;
  const Terrain& terrain = layout.terrain;
  for (std::size_t i = 1; i < posts.size(); ++i) {
    if (posts[i].row != posts[i - 1].row) continue;
    for (const double height : trellis.wires) {
      scene.wires.push_back({above(terrain, posts[i - 1], height).cast<float>(),
                             above(terrain, posts[i], height).cast<float>(), kWireRadius, steel});
    }
  }
  if (trellis.end_brace == Brackets::kAnchor) {
    for (const Brace& brace : trellis_braces(trellis, layout)) {
      scene.wires.push_back({brace.foot.cast<float>(), brace.head.cast<float>(),
                             static_cast<float>(brace.radius), steel});
    }
  }
  if (trellis.drip_line == 0) return;
  const int black = add_line_material(scene, "drip line", {0.035f, 0.038f, 0.042f});
  for (std::size_t i = 1; i < posts.size(); ++i) {
    if (posts[i].row != posts[i - 1].row) continue;
    add_drip_span(scene, above(terrain, posts[i - 1], trellis.drip_line),
                  above(terrain, posts[i], trellis.drip_line), trellis.drip_sag, black);
  }
}

}  // namespace

std::vector<Brace> trellis_braces(const WorldConfig::Trellis& trellis, const WorldLayout& layout) {
  const Terrain& terrain = layout.terrain;
  std::vector<Brace> braces;
  if (trellis.end_brace == Brackets::kNone) return braces;
  const bool strut = trellis.end_brace == Brackets::kStrut;
  for (const TrellisPost& post : layout.posts) {
    if (!post.end) continue;
    const RowConfig& row = layout.rows[static_cast<std::size_t>(post.row)];
    const Eigen::Vector2d along = (row.end - row.start).normalized();
    const Eigen::Vector2d inward = post.index == 0 ? along : Eigen::Vector2d(-along);
    const double reach = kBraceReach * trellis.post_height;
    // An anchor is outside of the leaning post's head.
    const double head = (strut ? kStrutHead : kAnchorHead) * trellis.post_height;
    const Eigen::Vector2d foot = strut ? Eigen::Vector2d(post.foot + reach * inward)
                                       : Eigen::Vector2d(post.at(head) - reach / 2 * inward);
    braces.push_back({{foot.x(), foot.y(), terrain.height(foot)},
                      above(terrain, post, head),
                      strut ? kStrutRadius : 2.0 * kWireRadius});
  }
  return braces;
}

void add_trellis(Scene& scene, const WorldConfig::Trellis& trellis, const WorldLayout& layout,
                 std::uint64_t seed) {
  add_posts(scene, trellis, layout, seed);
  add_wires(scene, trellis, layout);
}

}  // namespace vinebench::sim
