// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/ground.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/util/random.h"
#include "sim/assets/asset.h"
#include "sim/plants/grapevine_stage.h"
#include "sim/scene/mesh_builder.h"
#include "sim/textures/textures.h"
#include "sim/world/row_index.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kRowShade = 0.25;  // m on either side of a row, darkened by its canopy
constexpr double kSkirt = 0.06;     // m, height of a tile's skirt, against cracks between levels
constexpr int kLevels = 4;
constexpr std::array<double, kLevels> kUntil{6, 14, 40, 1e9};  // m
// Even ground is baked into the light map in full detail, and drawn in large triangles: small ones
// cost more, as every group of pixels that a triangle touches is shaded as a whole.
constexpr std::array<double, kLevels> kEvenUntil{0, 0, 6, 1e9};  // m

enum GroundMaterial { kPlain, kAisle };

/// Vertex grid of a strip: from, to and step in nodes.
struct Strip {
  int x0, x1, step_x, y0, y1, step_y;
};

class GroundMesher {
 public:
  GroundMesher(const WorldConfig& world, const WorldLayout& layout, std::uint64_t seed)
      : terrain_(layout.terrain),
        grass_(world.ground.aisles == WorldConfig::Ground::Aisles::kGrass),
        rows_(layout.rows),
        shade_(seed, "ground shade"),
        phase_(seed, "aisle phase") {
    const Terrain& terrain = layout.terrain;
    heights_.reserve(static_cast<std::size_t>(terrain.nodes()));
    for (int row = 0; row < terrain.rows(); ++row) {
      for (int column = 0; column < terrain.columns(); ++column) {
        heights_.push_back(terrain.node_height(column, row));
      }
    }
  }

  /// Levels of the tile whose first node is its frame's origin.
  std::vector<LevelOfDetail> tile(int tx, int ty) {
    corner_x_ = tx * terrain_.cells_x();
    corner_y_ = ty * terrain_.cells_y();
    const int quarter = (grass_ ? terrain_.cells_aisle() : terrain_.cells_y()) / 4;
    const std::array<Eigen::Array2i, kLevels> steps{
        {{1, 1}, {2, 2}, {10, quarter}, {20, 2 * quarter}}};
    std::vector<LevelOfDetail> levels;
    const std::array<double, kLevels>& until = terrain_.flat() ? kEvenUntil : kUntil;
    for (int i = 0; i < kLevels; ++i) {
      if (i == 0 || until[i] > until[i - 1]) levels.push_back(level(until[i], steps[i]));
    }
    return levels;
  }

  Pose tile_pose(int tx, int ty) const {
    const Vector2d at =
        terrain_.frame().to_world(terrain_.node(tx * terrain_.cells_x(), ty * terrain_.cells_y()));
    return {from_roll_pitch_yaw({0, 0, terrain_.frame().heading()}), {at.x(), at.y(), 0}};
  }

 private:
  double height(int column, int row) const {
    return heights_[static_cast<std::size_t>(row) * terrain_.columns() + column];
  }

  LevelOfDetail level(double until, const Eigen::Array2i& step) {
    std::array<Primitive, 2> parts;
    parts[kAisle].material = kAisle;
    // Textures of aisles end at the rows and, outside of these, in the middle of aisles.
    const int width = grass_ ? terrain_.cells_aisle() / 2 : terrain_.cells_y();
    for (int y = corner_y_; y < corner_y_ + terrain_.cells_y(); y += width) {
      const Strip strip{corner_x_, corner_x_ + terrain_.cells_x(), step.x(), y, y + width,
                        step.y()};
      add_strip(parts[in_aisles(strip) ? kAisle : kPlain], strip);
    }
    LevelOfDetail level{until, {}};
    for (Primitive& part : parts) {
      if (!part.indices.empty()) level.primitives.push_back(std::move(part));
    }
    return level;
  }

  bool in_aisles(const Strip& strip) const {
    if (!grass_) return false;
    const Vector2d middle =
        (terrain_.node(strip.x0, strip.y0) + terrain_.node(strip.x1, strip.y1)) / 2;
    Eigen::AlignedBox2d aisles = terrain_.frame().rows;
    const Vector2d beyond(kRowEnd, terrain_.frame().spacing / 2);
    aisles = {aisles.min() - beyond, aisles.max() + beyond};
    return aisles.contains(middle);
  }

  void add_strip(Primitive& part, const Strip& strip) {
    MeshBuilder builder(part);
    const bool aisle = in_aisles(strip);
    const int columns = (strip.x1 - strip.x0) / strip.step_x + 1;
    const int lines = (strip.y1 - strip.y0) / strip.step_y + 1;
    const auto first = static_cast<std::uint32_t>(part.vertices.size());
    for (int j = 0; j < lines; ++j) {
      for (int i = 0; i < columns; ++i) {
        part.vertices.push_back(
            vertex(strip.x0 + i * strip.step_x, strip.y0 + j * strip.step_y, strip.y0, aisle));
      }
    }
    const auto at = [&](int i, int j) {
      return first + static_cast<std::uint32_t>(j * columns + i);
    };
    for (int j = 0; j + 1 < lines; ++j) {
      for (int i = 0; i + 1 < columns; ++i) {
        builder.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
    std::vector<std::uint32_t> low_x, high_x, low_y, high_y;
    for (int j = 0; j < lines; ++j) {
      low_x.push_back(at(0, j));
      high_x.push_back(at(columns - 1, lines - 1 - j));
    }
    for (int i = 0; i < columns; ++i) {
      low_y.push_back(at(columns - 1 - i, 0));
      high_y.push_back(at(i, lines - 1));
    }
    add_skirt(part, low_x);
    add_skirt(part, high_x);
    if (strip.y0 == corner_y_) add_skirt(part, low_y);
    if (strip.y1 == corner_y_ + terrain_.cells_y()) add_skirt(part, high_y);
  }

  /// Adds a skirt below vertices whose outer side is on the right, seen from above.
  static void add_skirt(Primitive& part, const std::vector<std::uint32_t>& rim) {
    MeshBuilder builder(part);
    const auto below = static_cast<std::uint32_t>(part.vertices.size());
    for (const std::uint32_t top : rim) {
      Vertex hung = part.vertices[top];
      hung.position.z() -= static_cast<float>(kSkirt);
      part.vertices.push_back(hung);
    }
    for (std::uint32_t i = 0; i + 1 < rim.size(); ++i) {
      builder.quad(rim[i], rim[i + 1], below + i + 1, below + i);
    }
  }

  /// `strip_row` determines the aisle of a vertex on the border of two.
  Vertex vertex(int column, int row, int strip_row, bool aisle) const {
    const Vector2d p = terrain_.node(column, row);
    const Vector2d local = p - terrain_.node(corner_x_, corner_y_);
    Vertex v;
    v.position = Vector3d(local.x(), local.y(), height(column, row)).cast<float>();
    v.normal = normal(column, row);
    v.uv = (aisle ? aisle_uv(p, strip_row) : plain_uv(p)).cast<float>();
    const double near = rows_.distance(terrain_.frame().to_world(p)) / kRowShade;
    const auto index = static_cast<std::uint64_t>(row) * terrain_.columns() + column;
    v.occlusion =
        static_cast<float>(0.95 - 0.35 * std::exp(-near * near) - 0.10 * shade_.uniform(index));
    return v;
  }

  Vector3f normal(int column, int row) const {
    const int w = std::max(column - 1, 0), e = std::min(column + 1, terrain_.columns() - 1);
    const int s = std::max(row - 1, 0), n = std::min(row + 1, terrain_.rows() - 1);
    const double by_x = (height(e, row) - height(w, row)) / ((e - w) * terrain_.cell().x());
    const double by_y = (height(column, n) - height(column, s)) / ((n - s) * terrain_.cell().y());
    return Vector3d(-by_x, -by_y, 1).normalized().cast<float>();
  }

  static Vector2d plain_uv(const Vector2d& p) { return {p.x() / kSoilTile, -p.y() / kSoilTile}; }

  /// The texture spans one aisle from row to row; every aisle has its own section, and every second
  /// one is reversed.
  Vector2d aisle_uv(const Vector2d& p, int strip_row) const {
    const double width = terrain_.frame().spacing;
    const double half = terrain_.node(0, strip_row).y() + 0.25 * width;
    const double number = std::floor((half - terrain_.frame().rows.min().y()) / width + 1e-6);
    const double across = (p.y() - terrain_.frame().rows.min().y()) / width - number;
    const auto index = static_cast<std::uint64_t>(number + 1000);
    const bool turned = phase_.bits(2 * index) & 1;
    const double along = p.x() / (width * kAisleLength) + phase_.uniform(2 * index + 1);
    return {turned ? 1 - across : across, turned ? -along : along};
  }

  const Terrain& terrain_;
  bool grass_;
  RowIndex rows_;
  RandomStream shade_, phase_;
  std::vector<double> heights_;
  int corner_x_ = 0, corner_y_ = 0;
};

/// Lines of a grid from `low` to `high` and, ever coarser, to `half` beyond the middle.
std::vector<double> apron_lines(double low, double high, double half) {
  const double middle = (low + high) / 2;
  std::vector<double> lines;
  double step = 2;
  for (double x = low; x > middle - half; x -= step, step *= 1.6) lines.insert(lines.begin(), x);
  if (lines.empty() || lines.front() > middle - half) lines.insert(lines.begin(), middle - half);
  step = 2;
  for (double x = high; x < middle + half; x += step, step *= 1.6) lines.push_back(x);
  lines.push_back(middle + half);
  return lines;
}

/// Distant grass is enlarged and rotated to hide its repetition.
Vector2d apron_uv(const WorldConfig& world, const Vector2d& p) {
  const Vector2d uv(p.x() / kSoilTile, -p.y() / kSoilTile);
  if (world.ground.aisles == WorldConfig::Ground::Aisles::kSoil) return uv;
  constexpr double kLarger = 1.7, kAskew = 0.6;
  return Eigen::Rotation2Dd(kAskew) * uv / kLarger;
}

/// The ground between the tiles and the world's edge, in the rows' frame.
Primitive apron_mesh(const WorldConfig& world, const Terrain& terrain) {
  const Eigen::AlignedBox2d box = terrain.box();
  const double half = world.ground_size / 2;
  const auto xs = apron_lines(box.min().x(), box.max().x(), half);
  const auto ys = apron_lines(box.min().y(), box.max().y(), half);
  Primitive primitive;
  MeshBuilder builder(primitive);
  const Vector3d slope = terrain.normal(terrain.frame().to_world(2 * box.min() - box.max()), 1);
  const Vector3f up =
      (from_roll_pitch_yaw({0, 0, -terrain.frame().heading()}) * slope).cast<float>();
  for (const double y : ys) {
    for (const double x : xs) {
      const Vector2d on = box.min().cwiseMax(box.max().cwiseMin(Vector2d(x, y)));
      const bool edge = on == Vector2d(x, y);
      const double z = terrain.height(terrain.frame().to_world({x, y})) - (edge ? 0.001 : 0);
      builder.vertex(Vector3d(x, y, z).cast<float>(), up, apron_uv(world, {x, y}).cast<float>(),
                     0.9f);
    }
  }
  const auto columns = static_cast<std::uint32_t>(xs.size());
  for (std::uint32_t j = 0; j + 1 < ys.size(); ++j) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      if (box.contains(Vector2d(xs[i] + xs[i + 1], ys[j] + ys[j + 1]) / 2)) continue;
      const std::uint32_t a = j * columns + i;
      builder.quad(a, a + 1, a + columns + 1, a + columns);
    }
  }
  return primitive;
}

Asset ground_asset(const Scene& scene, const WorldConfig& world, const Terrain& terrain,
                   std::uint64_t seed) {
  Asset asset;
  const double withered = withered_share(world.vines.bbch);
  if (world.ground.aisles == WorldConfig::Ground::Aisles::kSoil) {
    asset.add(painted_texture(scene, "soil", [&] { return soil_texture(seed, withered); }));
    asset.add(make_material("soil", Label::kGround, 0));
    asset.materials[0].terrain = true;
    return asset;
  }
  const AisleProfile aisle{terrain.frame().spacing, world.ground.bare_strip,
                           world.ground.track_gauge, world.ground.track_width};
  asset.add(painted_texture(scene, "meadow", [&] { return meadow_texture(seed, withered); }));
  asset.add(painted_texture(scene, "aisle", [&] { return aisle_texture(seed, aisle, withered); }));
  asset.add(make_material("meadow", Label::kGrass, 0));
  asset.add(make_material("aisle", Label::kGround, 1));
  for (Material& material : asset.materials) material.terrain = true;
  return asset;
}

}  // namespace

void add_ground(Scene& scene, const WorldConfig& world, const WorldLayout& layout,
                std::uint64_t seed) {
  const Terrain& terrain = layout.terrain;
  Asset asset = ground_asset(scene, world, terrain, seed);
  GroundMesher mesher(world, layout, seed);
  // Textures are large: they are added to the scene once and shared by the tiles.
  asset.model.name = "apron";
  asset.model.levels.push_back({1e9, {apron_mesh(world, terrain)}});
  asset.update_bounds();
  const int base = static_cast<int>(scene.materials.size());
  const RowFrame& frame = terrain.frame();
  const Pose T_world_frame{from_roll_pitch_yaw({0, 0, frame.heading()}),
                           {frame.origin.x(), frame.origin.y(), 0}};
  scene.instances.push_back({add_asset(scene, std::move(asset)), T_world_frame, 1, 0});
  for (int ty = 0; ty < terrain.tiles_y(); ++ty) {
    for (int tx = 0; tx < terrain.tiles_x(); ++tx) {
      Asset tile;
      tile.model.name = "ground";
      tile.model.levels = mesher.tile(tx, ty);
      for (LevelOfDetail& level : tile.model.levels) {
        for (Primitive& part : level.primitives) part.material += base;
      }
      tile.update_bounds();
      scene.instances.push_back({static_cast<int>(scene.models.size()), mesher.tile_pose(tx, ty), 1,
                                 ty * terrain.tiles_x() + tx});
      scene.models.push_back(std::move(tile.model));
    }
  }
}

}  // namespace vinebench::sim
