// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "sim/scene/block_mesh.h"
#include "sim/textures/textures.h"
#include "sim/vineyard/occluders/occluder_shape.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kPersonHeight = 1.75;  // m, as the figure below is drawn
constexpr double kPersonFar = 8;        // m; coarser beyond

enum Cloth { kShirt, kTrousers, kSkin, kStraw, kShoe };

/// A limb with one bend.
struct Limb {
  Cloth cloth;
  std::vector<Vector3f> path;
  std::vector<float> radii;
};

/// Of one side of the body: 1 is the left, whose arm is raised a little.
void add_side(std::vector<Limb>& limbs, float side) {
  limbs.push_back({kShoe,
                   {{-0.105f, side * 0.11f, 0.04f},
                    {-0.085f, side * 0.11f, 0.042f},
                    {0.0f, side * 0.115f, 0.06f},
                    {0.165f, side * 0.13f, 0.035f},
                    {0.18f, side * 0.131f, 0.034f}},
                   {0.014f, 0.036f, 0.052f, 0.030f, 0.018f}});
  limbs.push_back(
      {kTrousers,
       {{-0.01f, side * 0.11f, 0.05f}, {0.02f, side * 0.11f, 0.48f}, {0.0f, side * 0.085f, 0.86f}},
       {0.065f, 0.075f, 0.088f}});
  limbs.push_back({kShirt,
                   {{0.0f, side * 0.12f, 1.43f},
                    {0.0f, side * 0.19f, 1.405f},
                    {0.01f, side * 0.222f, 1.29f},
                    {0.02f, side * 0.25f, 1.14f}},
                   {0.030f, 0.060f, 0.060f, 0.050f}});
  const float reach = side > 0 ? 0.34f : 0.10f, lift = side > 0 ? 1.18f : 0.82f;
  limbs.push_back({kSkin,
                   {{0.02f, side * 0.25f, 1.15f},
                    {reach, side * 0.22f, lift + 0.03f},
                    {reach + 0.08f, side * 0.21f, lift},
                    {reach + 0.11f, side * 0.205f, lift - 0.01f}},
                   {0.042f, 0.032f, 0.030f, 0.014f}});
}

/// A grower who stands with one arm raised a little, hat on the head; m. Limbs that can be seen
/// from their begin start with a small radius, which closes them.
std::vector<Limb> limbs_of_person() {
  std::vector<Limb> limbs;
  for (const float side : {-1.0f, 1.0f}) add_side(limbs, side);
  limbs.push_back({kTrousers,
                   {{0, 0, 0.77f}, {0, 0, 0.83f}, {0, 0, 0.90f}, {0, 0, 0.95f}},
                   {0.05f, 0.145f, 0.155f, 0.145f}});
  limbs.push_back({kShirt,
                   {{0, 0, 0.88f}, {0, 0, 0.89f}, {0.01f, 0, 1.18f}, {0, 0, 1.38f}, {0, 0, 1.47f}},
                   {0.12f, 0.164f, 0.166f, 0.175f, 0.075f}});
  limbs.push_back({kSkin,
                   {{0, 0, 1.44f},
                    {0.008f, 0, 1.50f},
                    {0.022f, 0, 1.545f},
                    {0.03f, 0, 1.60f},
                    {0.028f, 0, 1.66f},
                    {0.02f, 0, 1.72f}},
                   {0.052f, 0.054f, 0.070f, 0.086f, 0.088f, 0.060f}});
  limbs.push_back({kStraw,
                   {{0.02f, 0, 1.652f},
                    {0.02f, 0, 1.655f},
                    {0.02f, 0, 1.672f},
                    {0.02f, 0, 1.69f},
                    {0.02f, 0, 1.735f},
                    {0.02f, 0, 1.75f}},
                   {0.060f, 0.190f, 0.186f, 0.100f, 0.088f, 0.055f}});
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
  for (Vertex& vertex : cloths[kTrousers].vertices) {
    if (vertex.position.z() > 0.80f) vertex.position.x() *= 0.75f;
  }
  for (Primitive& cloth : cloths) {
    for (Vertex& vertex : cloth.vertices) vertex.occlusion = 0.75f;
  }
  return cloths;
}

double scale_of(const Occluder& person) {
  return person.height / kPersonHeight;
}

}  // namespace

OccluderModel person_model(const Occluder& occluder, std::uint64_t seed) {
  OccluderModel model{.scale = scale_of(occluder)};
  model.asset.add(cloth_texture(seed));
  const std::array<Vector3f, 5> colours{
      linear_colour(colour_of(occluder)), Vector3f(0.035f, 0.045f, 0.075f),
      Vector3f(0.45f, 0.24f, 0.15f), Vector3f(0.62f, 0.50f, 0.26f),
      Vector3f(0.05f, 0.035f, 0.025f)};
  const std::array<const char*, 5> names{"shirt", "trousers", "skin", "straw", "shoe"};
  for (std::size_t i = 0; i < colours.size(); ++i) {
    model.asset.add(make_material(names[i], label_of(class_of(occluder)), 0));
    model.asset.materials.back().colour = colours[i];
  }
  model.asset.model.levels = {{kPersonFar, person_mesh(14)}, {1e9, person_mesh(6)}};
  return model;
}

/// Feet and legs, trunk, and head.
std::vector<Block> person_blocks(const Occluder& occluder) {
  const double s = scale_of(occluder);
  return {{s * Vector3d(0.04, 0.115, 0.42), s * Vector3d(0.14, 0.07, 0.42)},
          {s * Vector3d(0.04, -0.115, 0.42), s * Vector3d(0.14, 0.07, 0.42)},
          {s * Vector3d(0.03, 0, 1.15), s * Vector3d(0.17, 0.28, 0.33)},
          {s * Vector3d(0.02, 0, 1.60), s * Vector3d(0.12, 0.12, 0.15)}};
}

}  // namespace vinebench::sim
