// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <utility>

#include "core/util/error.h"
#include "sim/assets/asset_file.h"
#include "sim/assets/gltf.h"

namespace vinebench::sim {
namespace {

using tinygltf::Value;

/// z up to glTF's y up.
Eigen::Vector3f y_up(const Eigen::Vector3f& v) {
  return {v.x(), v.z(), -v.y()};
}

/// A vertex as stored in the file, without padding bytes.
struct PackedVertex {
  explicit PackedVertex(const Vertex& vertex)
      : position(y_up(vertex.position)),
        normal(y_up(vertex.normal)),
        uv(vertex.uv),
        occlusion(vertex.occlusion),
        part(vertex.part) {}
  Eigen::Vector3f position, normal;
  Eigen::Vector2f uv;
  float occlusion;
  std::uint8_t part;
  std::array<std::uint8_t, 3> unused{};
};
static_assert(sizeof(PackedVertex) == 40, "vertices are written as stored in memory");

class GltfWriter {
 public:
  explicit GltfWriter(const Asset& asset) : GltfWriter(asset.textures, asset.materials) {
    add(asset.model);
  }

  GltfWriter(const Scene& scene, const std::vector<PlacedMesh>& placed)
      : GltfWriter(scene.textures, scene.materials) {
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    std::map<std::pair<int, int>, int> meshes;
    for (const PlacedMesh& one : placed) {
      const Model& model = scene.models.at(static_cast<std::size_t>(one.model));
      const LevelOfDetail& level = model.levels.at(static_cast<std::size_t>(one.level));
      if (triangle_count(level) == 0) continue;
      const auto [known, first] = meshes.try_emplace({one.model, one.level}, 0);
      if (first) known->second = add_mesh(model.name, level);
      place(known->second, one);
    }
  }

  std::string bytes() {
    std::ostringstream out;
    tinygltf::TinyGLTF writer;
    try {
      if (writer.WriteGltfSceneToStream(&model_, out, false, true)) return out.str();
    } catch (const std::exception& problem) {  // such as a name that is not UTF-8
      fail("a .glb cannot be written: {}", problem.what());
    }
    fail("a .glb cannot be written");
  }

 private:
  GltfWriter(const std::vector<Texture>& textures, const std::vector<Material>& materials) {
    model_.asset.version = "2.0";
    model_.asset.generator = "Vinebench";
    model_.buffers.emplace_back();
    for (const Texture& texture : textures) add(texture);
    for (const Material& material : materials) add(material);
  }

  /// Appends to the one buffer; returns the new view's index.
  int add_view(const void* data, std::size_t size, int target, std::size_t stride = 0) {
    std::vector<unsigned char>& buffer = model_.buffers[0].data;
    buffer.resize((buffer.size() + 3) / 4 * 4);  // numbers are aligned to their size
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = size;
    view.byteStride = stride;
    view.target = target;
    const auto* from = static_cast<const unsigned char*>(data);
    buffer.insert(buffer.end(), from, from + size);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  int add_accessor(int view, std::size_t offset, std::size_t count, int component, int type) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.byteOffset = offset;
    accessor.count = count;
    accessor.componentType = component;
    accessor.type = type;
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  void add(const Texture& texture) {
    cv::Mat bgra;
    cv::cvtColor(texture.rgba, bgra, cv::COLOR_RGBA2BGRA);
    std::vector<unsigned char> png;
    cv::imencode(".png", bgra, png);
    tinygltf::Image image;
    image.name = texture.name;
    image.mimeType = "image/png";
    image.bufferView = add_view(png.data(), png.size(), 0);
    model_.images.push_back(image);
    tinygltf::Sampler sampler;
    sampler.wrapS = sampler.wrapT =
        texture.repeat ? TINYGLTF_TEXTURE_WRAP_REPEAT : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model_.samplers.push_back(sampler);
    tinygltf::Texture entry;
    entry.source = entry.sampler = static_cast<int>(model_.images.size()) - 1;
    model_.textures.push_back(entry);
  }

  void add(const Material& material) {
    tinygltf::Material out;
    out.name = material.name;
    const Eigen::Vector3d colour = material.colour.cast<double>();
    out.pbrMetallicRoughness.baseColorFactor = {colour.x(), colour.y(), colour.z(), 1.0};
    out.pbrMetallicRoughness.baseColorTexture.index = material.texture;
    out.pbrMetallicRoughness.metallicFactor = 0;
    out.alphaMode = material.cutout ? "MASK" : "OPAQUE";
    out.doubleSided = material.double_sided;
    out.extras =
        Value(Value::Object{{kLabel, Value(std::string(name_of(material.label)))},
                            {kTranslucency, Value(static_cast<double>(material.translucency))}});
    model_.materials.push_back(out);
    has_colours_.push_back(material.vertex_colours);
  }

  tinygltf::Primitive part(const Primitive& primitive) {
    const std::vector<PackedVertex> vertices(primitive.vertices.begin(), primitive.vertices.end());
    Eigen::AlignedBox3f box;
    for (const PackedVertex& vertex : vertices) box.extend(vertex.position);
    const int view = add_view(vertices.data(), vertices.size() * sizeof(PackedVertex),
                              TINYGLTF_TARGET_ARRAY_BUFFER, sizeof(PackedVertex));
    const auto attribute = [&](std::size_t offset, int type,
                               int component = TINYGLTF_COMPONENT_TYPE_FLOAT) {
      return add_accessor(view, offset, vertices.size(), component, type);
    };
    tinygltf::Primitive out;
    out.mode = TINYGLTF_MODE_TRIANGLES;
    out.material = primitive.material;
    out.attributes["POSITION"] = attribute(offsetof(PackedVertex, position), TINYGLTF_TYPE_VEC3);
    tinygltf::Accessor& position = model_.accessors.back();
    position.minValues = {box.min().x(), box.min().y(), box.min().z()};
    position.maxValues = {box.max().x(), box.max().y(), box.max().z()};
    out.attributes["NORMAL"] = attribute(offsetof(PackedVertex, normal), TINYGLTF_TYPE_VEC3);
    out.attributes["TEXCOORD_0"] = attribute(offsetof(PackedVertex, uv), TINYGLTF_TYPE_VEC2);
    out.attributes[kOcclusion] = attribute(offsetof(PackedVertex, occlusion), TINYGLTF_TYPE_SCALAR);
    out.attributes[kPart] = attribute(offsetof(PackedVertex, part), TINYGLTF_TYPE_SCALAR,
                                      TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE);
    if (has_colours_.at(static_cast<std::size_t>(primitive.material))) add_colours(primitive, out);
    const std::vector<std::uint32_t>& indices = primitive.indices;
    const int list = add_view(indices.data(), indices.size() * sizeof(std::uint32_t),
                              TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    out.indices = add_accessor(list, 0, indices.size(), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                               TINYGLTF_TYPE_SCALAR);
    return out;
  }

  /// As linear light in floats, of which the reader makes the same bytes.
  void add_colours(const Primitive& primitive, tinygltf::Primitive& out) {
    std::vector<Eigen::Vector3f> colours;
    colours.reserve(primitive.vertices.size());
    for (const Vertex& vertex : primitive.vertices) colours.push_back(linear_colour(vertex.colour));
    const int view = add_view(colours.data(), colours.size() * sizeof(Eigen::Vector3f),
                              TINYGLTF_TARGET_ARRAY_BUFFER);
    out.attributes["COLOR_0"] =
        add_accessor(view, 0, colours.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
  }

  /// Returns its index.
  int add_mesh(const std::string& name, const LevelOfDetail& level) {
    tinygltf::Mesh mesh;
    mesh.name = name;
    for (const Primitive& primitive : level.primitives) mesh.primitives.push_back(part(primitive));
    model_.meshes.push_back(std::move(mesh));
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  void place(int mesh, const PlacedMesh& placed) {
    const Eigen::Vector3d at = placed.T_world_model.translation;
    const Eigen::Quaterniond& turn = placed.T_world_model.rotation;
    const auto scale = static_cast<double>(placed.scale);
    tinygltf::Node node;
    node.mesh = mesh;
    node.translation = {at.x(), at.z(), -at.y()};
    node.rotation = {turn.x(), turn.z(), -turn.y(), turn.w()};
    node.scale = {scale, scale, scale};
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.nodes.push_back(std::move(node));
  }

  void add(const Model& model) {
    Value::Array ids, until;
    for (const LevelOfDetail& level : model.levels) {
      tinygltf::Node node;
      node.name = model.name;
      node.mesh = add_mesh(model.name, level);
      if (node.mesh > 0) ids.emplace_back(node.mesh);
      until.emplace_back(level.until);
      model_.nodes.push_back(std::move(node));
    }
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
    if (model.levels.empty()) return;
    model_.scenes[0].nodes = {0};
    model_.nodes[0].extras = Value(Value::Object{{kUntil, Value(until)}});
    if (ids.empty()) return;
    model_.nodes[0].extensions[kLevelsExtension] = Value(Value::Object{{"ids", Value(ids)}});
    model_.extensionsUsed.emplace_back(kLevelsExtension);
  }

  tinygltf::Model model_;
  std::vector<bool> has_colours_;  ///< materials whose vertices have colours
};

}  // namespace

std::string to_glb(const Asset& asset) {
  return GltfWriter(asset).bytes();
}

std::string to_glb(const Scene& scene, const std::vector<PlacedMesh>& placed) {
  return GltfWriter(scene, placed).bytes();
}

}  // namespace vinebench::sim
