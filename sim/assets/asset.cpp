// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/asset.h"

#include <algorithm>
#include <cstring>

namespace vinebench::sim {
namespace {

bool same(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  if (a.data == b.data && a.step == b.step) return true;
  for (int row = 0; row < a.rows; ++row) {
    if (std::memcmp(a.ptr(row), b.ptr(row), a.cols * a.elemSize()) != 0) return false;
  }
  return true;
}

bool same(const Texture& a, const Texture& b) {
  return a.name == b.name && a.repeat == b.repeat && same(a.rgba, b.rgba);
}

bool same(const Material& a, const Material& b) {
  return a.name == b.name && a.label == b.label && a.colour == b.colour && a.texture == b.texture &&
         a.cutout == b.cutout && a.double_sided == b.double_sided &&
         a.translucency == b.translucency && a.terrain == b.terrain &&
         a.vertex_colours == b.vertex_colours;
}

template <class T>
int index_of_equal(std::vector<T>& items, T item) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (same(items[i], item)) return static_cast<int>(i);
  }
  items.push_back(std::move(item));
  return static_cast<int>(items.size()) - 1;
}

}  // namespace

int Asset::add(Texture texture) {
  textures.push_back(std::move(texture));
  return static_cast<int>(textures.size()) - 1;
}

int Asset::add(Material material) {
  materials.push_back(std::move(material));
  return static_cast<int>(materials.size()) - 1;
}

void Asset::update_bounds() {
  model.bounds.setEmpty();
  for (const LevelOfDetail& level : model.levels) {
    for (const Primitive& primitive : level.primitives) {
      for (const Vertex& vertex : primitive.vertices) model.bounds.extend(vertex.position);
    }
    if (!model.bounds.isEmpty()) return;
  }
}

int add_asset(Scene& scene, Asset asset) {
  std::vector<int> textures;
  for (Texture& texture : asset.textures) {
    textures.push_back(index_of_equal(scene.textures, std::move(texture)));
  }
  std::vector<int> materials;
  for (Material& material : asset.materials) {
    if (material.texture >= 0) material.texture = textures.at(material.texture);
    materials.push_back(index_of_equal(scene.materials, std::move(material)));
  }
  for (LevelOfDetail& level : asset.model.levels) {
    for (Primitive& primitive : level.primitives) {
      primitive.material = materials.at(primitive.material);
    }
  }
  scene.models.push_back(std::move(asset.model));
  return static_cast<int>(scene.models.size()) - 1;
}

Material make_material(std::string name, Label label, int texture) {
  Material material;
  material.name = std::move(name);
  material.label = label;
  material.texture = texture;
  return material;
}

int triangle_count(const LevelOfDetail& level) {
  std::size_t indices = 0;
  for (const Primitive& primitive : level.primitives) indices += primitive.indices.size();
  return static_cast<int>(indices / 3);
}

}  // namespace vinebench::sim
