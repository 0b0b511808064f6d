// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/util/random.h"
#include "sim/assets/asset.h"
#include "sim/plants/grapevine_stage.h"
#include "sim/scene/mesh_builder.h"
#include "sim/textures/textures.h"
#include "sim/vineyard/ground.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr double kHillsWithin = 165;  // m; nearer than the far plane from any rover position

/// A point of a wall around the origin.
Vector3f on_circle(double radius, int i, int n, double z) {
  const double turn = 2 * std::numbers::pi * (i % n) / n;
  return Eigen::Vector3d(radius * std::cos(turn), radius * std::sin(turn), z).cast<float>();
}

constexpr auto kInset = static_cast<float>(kWallInset);

/// A wall that faces the centre, with `foot(i)` and the `height(i)` of its top above it.
template <class Foot, class Height>
Primitive ring_wall(double radius, int n, float u_repeat, const Foot& foot, const Height& height) {
  Primitive primitive;
  MeshBuilder builder(primitive);
  for (int i = 0; i <= n; ++i) {
    const Vector3f inward = -on_circle(1, i, n, 0);
    const float u = u_repeat * static_cast<float>(i) / n;
    builder.vertex(on_circle(radius, i, n, foot(i % n)), inward, {u, 1 - kInset}, 0.5f);
    builder.vertex(on_circle(radius, i, n, foot(i % n) + height(i % n)), inward, {u, kInset});
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
    builder.quad(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2);
  }
  return primitive;
}

void add_round(Scene& scene, const Eigen::Vector2d& middle, Asset asset) {
  asset.update_bounds();
  const Pose pose{Eigen::Quaterniond::Identity(), {middle.x(), middle.y(), 0}};
  scene.instances.push_back({add_asset(scene, std::move(asset)), pose, 1, 0});
}

}  // namespace

void add_backdrop(Scene& scene, const WorldConfig& world, const Terrain& terrain,
                  std::uint64_t seed) {
  const Eigen::Vector2d middle = terrain.frame().middle();
  const double edge = 0.5 * world.ground_size;
  const double withered = withered_share(world.vines.bbch);
  Asset hedge;
  hedge.add(painted_texture(scene, "hedge", [&] { return hedge_texture(seed, withered); }));
  hedge.add(make_material("hedge", Label::kGrass, 0));
  hedge.materials[0].cutout = true;
  hedge.model.name = "hedge";
  const auto foot = [&](int i) {
    const Eigen::Vector2d on = on_circle(0.97 * edge, i, 64, 0).head<2>().cast<double>();
    return terrain.height(middle + on) - 0.05;
  };
  const float repeats =
      static_cast<float>(std::max(1.0, std::round(2 * std::numbers::pi * edge / kHedgeLength)));
  hedge.model.levels.push_back(
      {1e9, {ring_wall(0.97 * edge, 64, repeats, foot, [](int) { return kHedgeTop; })}});
  add_round(scene, middle, std::move(hedge));

  const RandomStream random(seed, "hills");
  Asset hills;
  hills.add(painted_texture(scene, "woods", [&] { return woods_texture(seed, withered); }));
  hills.add(make_material("hills", Label::kGrass, 0));
  hills.model.name = "hills";
  const double far = std::min(4 * edge, kHillsWithin);
  if (far < 1.1 * edge) return;  // hidden by the hedge
  const auto height = [&](int i) {
    const double a = 2 * std::numbers::pi * i / 96;
    const double wave = std::sin(3 * a + random.uniform(0, 0, 6)) +
                        0.6 * std::sin(7 * a + random.uniform(1, 0, 6)) +
                        0.3 * std::sin(17 * a + random.uniform(2, 0, 6));
    return far * (0.19 + 0.03 * wave);
  };
  hills.model.levels.push_back({1e9,
                                {ring_wall(
                                    far, 96, 8, [](int) { return -1.0; }, height)}});
  add_round(scene, middle, std::move(hills));
}

}  // namespace vinebench::sim
