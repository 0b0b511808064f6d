// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/props.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/asset.h"
#include "sim/plant_geometry.h"
#include "sim/tag_family.h"
#include "sim/textures.h"
#include "slam/base/random.h"

namespace vinebench {
namespace {

using Eigen::Vector3f;

constexpr int kTexelsAModule = 32;
constexpr int kBoardRim = 1;               // modules of white round the print
constexpr float kBoardThickness = 0.005f;  // m

float linear(double srgb) {
  return static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

/// One face of a block: its middle, and half its sides to the right and up as seen from outside.
void add_face(MeshBuilder& builder, const Vector3f& middle, const Vector3f& right,
              const Vector3f& up, const TextureCell& cell, float foot_occlusion = 1) {
  const Vector3f normal = right.cross(up).normalized();
  const auto a = builder.vertex(middle - right - up, normal, cell.at(0, 1), foot_occlusion);
  const auto b = builder.vertex(middle + right - up, normal, cell.at(1, 1), foot_occlusion);
  const auto c = builder.vertex(middle + right + up, normal, cell.at(1, 0));
  const auto d = builder.vertex(middle - right + up, normal, cell.at(0, 0));
  builder.quad(a, b, c, d);
}

LevelOfDetail post_level(const WorldConfig::Trellis& trellis, double until, int sides) {
  const auto height = static_cast<float>(trellis.post_height);
  const auto radius = static_cast<float>(trellis.post_radius);
  Primitive primitive;
  MeshBuilder(primitive).tube(
      {{{0, 0, -0.05f}, {0, 0, height / 2}, {0, 0, height}}, {radius, radius, radius}}, sides, 1.5f,
      true);
  for (Vertex& vertex : primitive.vertices) {
    if (vertex.position.z() < 0) vertex.occlusion = 0.4f;
  }
  return {until, {primitive}};
}

void add_wires(Scene& scene, const WorldConfig& world) {
  scene.materials.push_back(make_material("wire", Label::kWire, -1));
  scene.materials.back().colour = {0.30f, 0.31f, 0.32f};
  const int material = static_cast<int>(scene.materials.size()) - 1;
  for (const WorldConfig::Row& row : world.rows) {
    WorldConfig only = world;
    only.rows = {row};
    const auto posts = post_positions(only);
    for (std::size_t i = 1; i < posts.size(); ++i) {
      for (const double height : world.trellis.wires) {
        const auto at = [&](const Eigen::Vector2d& p) {
          return Eigen::Vector3d(p.x(), p.y(), height).cast<float>().eval();
        };
        scene.wires.push_back({at(posts[i - 1]), at(posts[i]), 0.0012f, material});
      }
    }
  }
}

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

void add_trellis(Scene& scene, const WorldConfig& world, std::uint64_t seed) {
  Asset post;
  post.add(wood_texture(seed));
  post.add(make_material("post", Label::kPost, 0));
  post.model.name = "post";
  post.model.levels = {post_level(world.trellis, 4, 12), post_level(world.trellis, 1e9, 6)};
  post.update_bounds();
  const int model = add_asset(scene, std::move(post));
  const RandomStream random(seed, "posts");
  int id = 0;
  for (const Eigen::Vector2d& at : post_positions(world)) {
    const double turn = random.uniform(static_cast<std::uint64_t>(id), 0, 2 * std::numbers::pi);
    const Pose pose{from_roll_pitch_yaw({0, 0, turn}), {at.x(), at.y(), 0}};
    scene.instances.push_back({model, pose, 1, id++});
  }
  add_wires(scene, world);
}

void add_boxes(Scene& scene, const WorldConfig& world, std::uint64_t seed) {
  int id = 0;
  for (const WorldConfig::Box& box : world.boxes) {
    Asset carton;
    carton.add(carton_texture(seed));
    carton.add(make_material(box.name, Label::kBox, 0));
    carton.materials[0].colour = {linear(box.colour.x()), linear(box.colour.y()),
                                  linear(box.colour.z())};
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
  cv::copyMakeBorder(TagFamily(family).picture(id), modules, kBoardRim, kBoardRim, kBoardRim,
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

}  // namespace vinebench
