// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/props.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/util/random.h"
#include "sim/assets/asset.h"
#include "sim/scene/mesh_builder.h"
#include "sim/textures/textures.h"
#include "sim/world/tag_family.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr int kTexelsAModule = 32;
constexpr int kBoardRim = 1;  // modules of white round the print
constexpr auto kBoardThickness = static_cast<float>(kTagBoardThickness);

/// Rectangles of carton_texture.
const TextureCell kPlainCarton{{0.01f, 0.01f}, {0.99f, 0.49f}};
const TextureCell kTapedCarton{{0.01f, 0.51f}, {0.99f, 0.99f}};

Primitive box_mesh(const Vector3f& half) {
  const Vector3f x = half.x() * Vector3f::UnitX();
  const Vector3f y = half.y() * Vector3f::UnitY();
  const Vector3f z = half.z() * Vector3f::UnitZ();
  constexpr float kFootLight = 0.55f;
  Primitive primitive;
  MeshBuilder builder(primitive);
  add_face(builder, x, y, z, kTapedCarton, kFootLight);
  add_face(builder, -x, -y, z, kTapedCarton, kFootLight);
  add_face(builder, -y, x, z, kPlainCarton, kFootLight);
  add_face(builder, y, -x, z, kPlainCarton, kFootLight);
  add_face(builder, z, -y, x, kTapedCarton);
  add_face(builder, -z, y, x, kPlainCarton, kFootLight);
  return primitive;
}

/// The board behind the print: four rims and the back, in the tag's frame.
Primitive board_mesh(float half) {
  const Vector3f x = half * Vector3f::UnitX(), y = half * Vector3f::UnitY();
  const Vector3f z = kBoardThickness / 2 * Vector3f::UnitZ();
  Primitive primitive;
  MeshBuilder builder(primitive);
  const TextureCell cell;
  add_face(builder, 2 * z, x, y, cell);
  add_face(builder, z + x, y, z, cell);
  add_face(builder, z - x, z, y, cell);
  add_face(builder, z + y, z, x, cell);
  add_face(builder, z - y, x, z, cell);
  return primitive;
}

}  // namespace

Vector3f linear_colour(const Eigen::Vector3d& srgb) {
  const auto linear = [](double c) {
    return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  };
  return {linear(srgb.x()), linear(srgb.y()), linear(srgb.z())};
}

void add_face(MeshBuilder& builder, const Vector3f& middle, const Vector3f& right,
              const Vector3f& up, const TextureCell& cell, float foot_occlusion) {
  const Vector3f normal = right.cross(up).normalized();
  const auto a = builder.vertex(middle - right - up, normal, cell.at(0, 1), foot_occlusion);
  const auto b = builder.vertex(middle + right - up, normal, cell.at(1, 1), foot_occlusion);
  const auto c = builder.vertex(middle + right + up, normal, cell.at(1, 0));
  const auto d = builder.vertex(middle - right + up, normal, cell.at(0, 0));
  builder.quad(a, b, c, d);
}

void add_block(MeshBuilder& builder, const Vector3f& centre, const Vector3f& half,
               float foot_occlusion) {
  const Vector3f x = half.x() * Vector3f::UnitX(), y = half.y() * Vector3f::UnitY();
  const Vector3f z = half.z() * Vector3f::UnitZ();
  const TextureCell cell;
  add_face(builder, centre + x, y, z, cell, foot_occlusion);
  add_face(builder, centre - x, -y, z, cell, foot_occlusion);
  add_face(builder, centre - y, x, z, cell, foot_occlusion);
  add_face(builder, centre + y, -x, z, cell, foot_occlusion);
  add_face(builder, centre + z, -y, x, cell);
  add_face(builder, centre - z, y, x, cell, foot_occlusion);
}

void add_boxes(Scene& scene, const WorldConfig& world, std::uint64_t seed) {
  int id = 0;
  for (const WorldConfig::Box& box : world.boxes) {
    Asset carton;
    carton.add(box.printed ? print_texture(static_cast<std::uint64_t>(box.print_seed))
                           : carton_texture(seed));
    carton.add(make_material(box.name, Label::kBox, 0));
    carton.materials[0].colour = linear_colour(box.colour);
    carton.model.name = box.name;
    carton.model.levels.push_back({1e9, {box_mesh((box.size / 2).cast<float>())}});
    carton.update_bounds();
    scene.instances.push_back({add_asset(scene, std::move(carton)), box_pose(box), 1, id++});
  }
}

double tag_board_scale(const std::string& name) {
  const TagFamily family(name);
  return static_cast<double>(family.modules() + 2 * kBoardRim) / family.border_modules();
}

Texture tag_texture(const std::string& family, int id) {
  cv::Mat modules, large, rgba;
  cv::copyMakeBorder(TagFamily(family).image(id), modules, kBoardRim, kBoardRim, kBoardRim,
                     kBoardRim, cv::BORDER_CONSTANT, 255);
  // Printer's ink and paper are neither black nor white.
  modules = 14 + modules * (222.0 / 255.0);
  cv::resize(modules, large, {}, kTexelsAModule, kTexelsAModule, cv::INTER_NEAREST);
  cv::cvtColor(large, rgba, cv::COLOR_GRAY2RGBA);
  return {fmt::format("{}-{}", family, id), rgba, false};
}

void add_tags(Scene& scene, const WorldConfig& world) {
  int index = 0;
  for (const WorldConfig::Tag& tag : world.tags) {
    const auto half = static_cast<float>(tag.size * tag_board_scale(tag.family) / 2);
    Asset asset;
    asset.add(tag_texture(tag.family, tag.id));
    asset.add(make_material(asset.textures[0].name, Label::kTag, 0));
    asset.add(make_material("board", Label::kTag, -1));
    asset.materials[1].colour.setConstant(0.75f);
    Primitive print;
    MeshBuilder builder(print);
    // Seen from the front, x points right and y down: -y is up.
    add_face(builder, Vector3f::Zero(), half * Vector3f::UnitX(), -half * Vector3f::UnitY(), {});
    Primitive board = board_mesh(half);
    board.material = 1;
    asset.model.name = asset.textures[0].name;
    asset.model.levels.push_back({1e9, {std::move(print), std::move(board)}});
    asset.update_bounds();
    scene.instances.push_back({add_asset(scene, std::move(asset)), tag_pose(tag), 1, index++});
  }
}

}  // namespace vinebench::sim
