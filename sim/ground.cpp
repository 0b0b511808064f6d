// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/asset.h"
#include "sim/plant_geometry.h"
#include "sim/textures.h"
#include "slam/base/random.h"

namespace vinebench {
namespace {

using Eigen::Vector3f;

constexpr double kRowShade = 0.25;  // m either side of a row that its canopy darkens

double distance_to_rows(const WorldConfig& world, const Eigen::Vector2d& p) {
  double nearest = 1e9;
  for (const WorldConfig::Row& row : world.rows) {
    const Eigen::Vector2d along = row.end - row.start;
    const double t = std::clamp((p - row.start).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - row.start - t * along).norm());
  }
  return nearest;
}

/// Lines of a grid from -half to half: fine between `low` and `high`, ever coarser outside.
std::vector<double> grid_lines(double half, double low, double high) {
  constexpr double kFine = 0.2;
  constexpr int kMostFine = 80;
  low = std::clamp(low, -half, half);
  high = std::clamp(high, -half, half);
  const int n = std::clamp(static_cast<int>((high - low) / kFine) + 1, 2, kMostFine);
  std::vector<double> lines;
  for (int i = 0; i <= n; ++i) lines.push_back(low + (high - low) * i / n);
  double step = 2 * kFine;
  for (double x = high + step; x < half - step; x += step *= 1.6) lines.push_back(x);
  lines.push_back(half);
  std::vector<double> before;
  step = 2 * kFine;
  for (double x = low - step; x > -half + step; x -= step *= 1.6) before.push_back(x);
  before.push_back(-half);
  lines.insert(lines.begin(), before.rbegin(), before.rend());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

Primitive ground_mesh(const WorldConfig& world, std::uint64_t seed) {
  const Eigen::AlignedBox2d box = rows_box(world);
  const double half = world.ground_size / 2;
  const auto xs = grid_lines(half, box.min().x() - 1, box.max().x() + 1);
  const auto ys = grid_lines(half, box.min().y() - 1, box.max().y() + 1);
  const RandomStream random(seed, "ground shade");
  Primitive primitive;
  MeshBuilder builder(primitive);
  for (std::size_t j = 0; j < ys.size(); ++j) {
    for (std::size_t i = 0; i < xs.size(); ++i) {
      const double under =
          std::exp(-std::pow(distance_to_rows(world, {xs[i], ys[j]}) / kRowShade, 2));
      const double light = 0.95 - 0.35 * under - 0.10 * random.uniform(j * xs.size() + i);
      builder.vertex(Vector3f(static_cast<float>(xs[i]), static_cast<float>(ys[j]), 0),
                     Vector3f::UnitZ(),
                     Eigen::Vector2d(xs[i] / kSoilTile, -ys[j] / kSoilTile).cast<float>(),
                     static_cast<float>(light));
    }
  }
  const auto columns = static_cast<std::uint32_t>(xs.size());
  for (std::uint32_t j = 0; j + 1 < ys.size(); ++j) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t a = j * columns + i;
      builder.quad(a, a + 1, a + columns + 1, a + columns);
    }
  }
  return primitive;
}

/// A point of a wall round the origin.
Vector3f on_circle(double radius, int i, int n, double z) {
  const double turn = 2 * std::numbers::pi * (i % n) / n;
  return Eigen::Vector3d(radius * std::cos(turn), radius * std::sin(turn), z).cast<float>();
}

/// The picture of a wall repeats along it; from its very edges the other side would shine through.
constexpr float kInset = 0.06f;

/// A wall that faces the origin; `height(i)` of its top above `foot`.
template <class Height>
Primitive ring_wall(double radius, double foot, int n, float u_repeat, const Height& height) {
  Primitive primitive;
  MeshBuilder builder(primitive);
  for (int i = 0; i <= n; ++i) {
    const Vector3f inward = -on_circle(1, i, n, 0);
    const float u = u_repeat * static_cast<float>(i) / n;
    builder.vertex(on_circle(radius, i, n, foot), inward, {u, 1 - kInset}, 0.5f);
    builder.vertex(on_circle(radius, i, n, foot + height(i % n)), inward, {u, kInset});
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
    builder.quad(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2);
  }
  return primitive;
}

void add_single(Scene& scene, Asset asset) {
  asset.update_bounds();
  scene.instances.push_back({add_asset(scene, std::move(asset)), Pose{}, 1, 0});
}

}  // namespace

Eigen::AlignedBox2d rows_box(const WorldConfig& world) {
  Eigen::AlignedBox2d box;
  for (const WorldConfig::Row& row : world.rows) {
    box.extend(row.start);
    box.extend(row.end);
  }
  return box;
}

void add_ground(Scene& scene, const WorldConfig& world, std::uint64_t seed) {
  Asset asset;
  asset.add(soil_texture(seed));
  asset.add(make_material("soil", Label::kGround, 0));
  asset.materials[0].terrain = true;
  asset.model.name = "ground";
  asset.model.levels.push_back({1e9, {ground_mesh(world, seed)}});
  add_single(scene, std::move(asset));
}

void add_backdrop(Scene& scene, const WorldConfig& world, std::uint64_t seed) {
  const double edge = 0.5 * world.ground_size;
  Asset hedge;
  hedge.add(hedge_texture(seed));
  hedge.add(make_material("hedge", Label::kGrass, 0));
  hedge.materials[0].cutout = true;
  hedge.model.name = "hedge";
  const float repeats =
      static_cast<float>(std::max(1.0, std::round(2 * std::numbers::pi * edge / 50)));
  hedge.model.levels.push_back(
      {1e9, {ring_wall(0.97 * edge, -0.05, 64, repeats, [](int) { return 6.0; })}});
  add_single(scene, std::move(hedge));

  const RandomStream random(seed, "hills");
  Asset hills;
  hills.add(make_material("hills", Label::kGrass, -1));
  hills.materials[0].colour = {0.16f, 0.22f, 0.20f};
  hills.model.name = "hills";
  const double far = 4 * edge;
  const auto height = [&](int i) {
    const double a = 2 * std::numbers::pi * i / 96;
    const double wave = std::sin(3 * a + random.uniform(0, 0, 6)) +
                        0.6 * std::sin(7 * a + random.uniform(1, 0, 6)) +
                        0.3 * std::sin(17 * a + random.uniform(2, 0, 6));
    return far * (0.19 + 0.03 * wave);
  };
  hills.model.levels.push_back({1e9, {ring_wall(far, -1, 96, 1, height)}});
  add_single(scene, std::move(hills));
}

}  // namespace vinebench
