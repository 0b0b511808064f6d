// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/props.h"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "sim/assets/asset.h"
#include "sim/scene/block_mesh.h"
#include "sim/world/tag_family.h"

namespace vinebench::sim {
namespace {

using Eigen::Vector3f;

constexpr int kTexelsAModule = 32;
constexpr auto kBoardThickness = static_cast<float>(kTagBoardThickness);

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

Texture tag_texture(const std::string& family, int id) {
  cv::Mat modules, large, rgba;
  cv::copyMakeBorder(TagFamily(family).image(id), modules, kTagBoardRim, kTagBoardRim, kTagBoardRim,
                     kTagBoardRim, cv::BORDER_CONSTANT, 255);
  // Printer's ink and paper are neither black nor white.
  modules = 14 + modules * (222.0 / 255.0);
  cv::resize(modules, large, {}, kTexelsAModule, kTexelsAModule, cv::INTER_NEAREST);
  cv::cvtColor(large, rgba, cv::COLOR_GRAY2RGBA);
  return {fmt::format("{}-{}", family, id), rgba, false};
}

void add_tags(Scene& scene, const WorldConfig& world, const WorldLayout& layout) {
  for (std::size_t i = 0; i < world.tags.size(); ++i) {
    const WorldConfig::Tag& tag = world.tags[i];
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
    scene.instances.push_back(
        {add_asset(scene, std::move(asset)), tag_pose(layout.tags[i]), 1, static_cast<int>(i)});
  }
}

}  // namespace vinebench::sim
