// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/obstacles.h"

#include <cmath>
#include <numbers>

#include "sim/assets/asset.h"
#include "sim/scene/mesh_builder.h"
#include "sim/textures/textures.h"
#include "sim/vineyard/props.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kPersonHeight = 1.75;        // m, as the figure below is drawn
const Vector3d kCrateHalf{0.30, 0.20, 0.15};  // m, a common harvest crate
constexpr double kFar = 8;                    // m; coarser beyond

enum Cloth { kShirt, kTrousers, kSkin, kStraw, kShoe };

/// A limb with one bend.
struct Limb {
  Cloth cloth;
  std::vector<Vector3f> path;
  std::vector<float> radii;
};

/// A grower who stands with one arm raised a little, hat on the head; m.
std::vector<Limb> limbs_of_person() {
  std::vector<Limb> limbs;
  for (const float side : {-1.0f, 1.0f}) {
    limbs.push_back({kShoe,
                     {{-0.09f, side * 0.11f, 0.04f},
                      {0.0f, side * 0.115f, 0.06f},
                      {0.17f, side * 0.13f, 0.035f}},
                     {0.035f, 0.052f, 0.030f}});
    limbs.push_back(
        {kTrousers,
         {{-0.01f, side * 0.11f, 0.05f}, {0.02f, side * 0.11f, 0.48f}, {0.0f, side * 0.09f, 0.90f}},
         {0.065f, 0.075f, 0.098f}});
    const float reach = side > 0 ? 0.34f : 0.10f, lift = side > 0 ? 1.18f : 0.82f;
    limbs.push_back(
        {kShirt, {{0.0f, side * 0.19f, 1.42f}, {0.02f, side * 0.25f, 1.14f}}, {0.062f, 0.047f}});
    limbs.push_back({kSkin,
                     {{0.02f, side * 0.25f, 1.15f},
                      {reach, side * 0.22f, lift + 0.03f},
                      {reach + 0.08f, side * 0.21f, lift}},
                     {0.042f, 0.032f, 0.028f}});
  }
  limbs.push_back({kTrousers, {{0, 0, 0.80f}, {0, 0, 0.98f}}, {0.150f, 0.155f}});
  limbs.push_back({kShirt,
                   {{0, 0, 0.93f}, {0.01f, 0, 1.18f}, {0, 0, 1.38f}, {0, 0, 1.47f}},
                   {0.155f, 0.165f, 0.175f, 0.075f}});
  limbs.push_back({kSkin,
                   {{0, 0, 1.45f}, {0.015f, 0, 1.53f}, {0.03f, 0, 1.62f}, {0.02f, 0, 1.70f}},
                   {0.055f, 0.065f, 0.088f, 0.070f}});
  limbs.push_back({kStraw,
                   {{0.02f, 0, 1.655f}, {0.02f, 0, 1.675f}, {0.02f, 0, 1.69f}, {0.02f, 0, 1.75f}},
                   {0.190f, 0.185f, 0.100f, 0.080f}});
  return limbs;
}

std::vector<Primitive> person_mesh(int sides) {
  std::vector<Primitive> cloths(5);
  for (int i = 0; i < 5; ++i) cloths[static_cast<std::size_t>(i)].material = i;
  for (const Limb& limb : limbs_of_person()) {
    MeshBuilder(cloths[limb.cloth]).tube({limb.path, limb.radii}, sides, 2, true);
  }
  // The body is flatter than it is wide.
  for (Vertex& vertex : cloths[kShirt].vertices) {
    if (std::abs(vertex.position.y()) < 0.18f) vertex.position.x() *= 0.72f;
  }
  for (Primitive& cloth : cloths) {
    for (Vertex& vertex : cloth.vertices) vertex.occlusion = 0.75f;
  }
  return cloths;
}

Asset person(const WorldConfig::Obstacle& obstacle, std::uint64_t seed) {
  Asset asset;
  asset.add(cloth_texture(seed));
  const std::array<Vector3f, 5> colours{
      linear_colour(obstacle.colour), Vector3f(0.035f, 0.045f, 0.075f),
      Vector3f(0.45f, 0.24f, 0.15f), Vector3f(0.62f, 0.50f, 0.26f),
      Vector3f(0.05f, 0.035f, 0.025f)};
  const std::array<const char*, 5> names{"shirt", "trousers", "skin", "straw", "shoe"};
  for (std::size_t i = 0; i < colours.size(); ++i) {
    asset.add(make_material(names[i], Label::kPerson, 0));
    asset.materials.back().colour = colours[i];
  }
  asset.model.levels = {{kFar, person_mesh(14)}, {1e9, person_mesh(6)}};
  return asset;
}

/// Slats between corner posts round an open top, and a floor.
Primitive crate_mesh(bool fine) {
  Primitive primitive;
  MeshBuilder builder(primitive);
  const Vector3f half = kCrateHalf.cast<float>();
  const auto block = [&](const Vector3f& centre, const Vector3f& size) {
    add_block(builder, centre, size, 0.7f);
  };
  constexpr float kWall = 0.008f;
  const int slats = fine ? 4 : 1;
  const float pitch = 2 * half.z() / slats;
  for (int i = 0; i < slats; ++i) {
    const float z = (i + 0.5f) * pitch, tall = fine ? 0.36f * pitch : 0.5f * pitch;
    for (const float side : {-1.0f, 1.0f}) {
      block({side * half.x(), 0, z}, {kWall, half.y(), tall});
      block({0, side * half.y(), z}, {half.x(), kWall, tall});
    }
  }
  for (const float x : {-1.0f, 1.0f}) {
    for (const float y : {-1.0f, 1.0f}) {
      block({x * (half.x() - kWall), y * (half.y() - kWall), half.z()},
            {0.025f, 0.025f, half.z() + 0.004f});
    }
  }
  block({0, 0, 0.02f}, {half.x(), half.y(), 0.01f});
  return primitive;
}

Asset crate(const WorldConfig::Obstacle& obstacle, std::uint64_t seed) {
  Asset asset;
  asset.add(cloth_texture(seed));
  asset.add(make_material("crate", Label::kBox, 0));
  asset.materials[0].colour = linear_colour(obstacle.colour);
  asset.model.levels = {{kFar, {crate_mesh(true)}}, {1e9, {crate_mesh(false)}}};
  return asset;
}

double scale_of(const WorldConfig::Obstacle& obstacle) {
  const bool person = obstacle.kind == WorldConfig::Obstacle::Kind::kPerson;
  return person ? obstacle.height / kPersonHeight : 1;
}

}  // namespace

Pose obstacle_pose(const WorldConfig::Obstacle& obstacle, const Terrain& terrain) {
  const double yaw = obstacle.yaw_deg * kRadians;
  if (obstacle.kind == WorldConfig::Obstacle::Kind::kCrate) {
    return terrain.lie(obstacle.position, yaw, kCrateHalf.y());
  }
  const Eigen::Vector2d& at = obstacle.position;
  return {from_roll_pitch_yaw({0, 0, yaw}), {at.x(), at.y(), terrain.height(at)}};
}

std::vector<Block> obstacle_blocks(const WorldConfig::Obstacle& obstacle) {
  if (obstacle.kind == WorldConfig::Obstacle::Kind::kCrate) {
    return {{kCrateHalf.z() * Vector3d::UnitZ(), kCrateHalf}};
  }
  // Feet and legs, trunk, and head, of the figure at its own size.
  const double s = scale_of(obstacle);
  return {{s * Vector3d(0.04, 0.115, 0.42), s * Vector3d(0.14, 0.07, 0.42)},
          {s * Vector3d(0.04, -0.115, 0.42), s * Vector3d(0.14, 0.07, 0.42)},
          {s * Vector3d(0.03, 0, 1.15), s * Vector3d(0.17, 0.28, 0.33)},
          {s * Vector3d(0.02, 0, 1.60), s * Vector3d(0.12, 0.12, 0.15)}};
}

void add_obstacles(Scene& scene, const WorldConfig& world, const Terrain& terrain,
                   std::uint64_t seed) {
  int id = 0;
  for (const WorldConfig::Obstacle& obstacle : world.obstacles) {
    const bool is_person = obstacle.kind == WorldConfig::Obstacle::Kind::kPerson;
    Asset asset = is_person ? person(obstacle, seed) : crate(obstacle, seed);
    asset.model.name = is_person ? "person" : "crate";
    asset.update_bounds();
    scene.instances.push_back({add_asset(scene, std::move(asset)), obstacle_pose(obstacle, terrain),
                               static_cast<float>(scale_of(obstacle)), id++});
  }
}

}  // namespace vinebench::sim
