// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/util/error.h"
#include "sim/assets/asset_file.h"
#include "sim/assets/gltf.h"
#include "sim/assets/gltf_accessor.h"
#include "sim/assets/gltf_file.h"
#include "sim/assets/gltf_materials.h"

namespace vinebench::sim {
namespace {

using tinygltf::Value;

/// glTF's y up to z up.
Eigen::Matrix4f z_up() {
  Eigen::Matrix4f m = Eigen::Matrix4f::Zero();
  m(0, 0) = m(2, 1) = m(3, 3) = 1;
  m(1, 2) = -1;
  return m;
}

class GltfReader {
 public:
  GltfReader(const std::string& bytes, const std::filesystem::path& file, Strictness strictness,
             DecodedImages& images)
      : images_(images),
        file_(file.string()),
        lenient_(strictness == Strictness::kLenient),
        model_(parse_gltf(bytes, file)) {
    mesh_.up_axis = UpAxis::kY;
  }

  ImportedMesh read() {
    const Strictness strictness = lenient_ ? Strictness::kLenient : Strictness::kStrict;
    read_gltf_materials(model_, file_, strictness, images_, mesh_);
    asset_.model.name = std::filesystem::path(file_).stem().string();
    note_contents();
    add_levels();
    return std::move(mesh_);
  }

 private:
  /// What is not drawn of the file.
  void note_contents() {
    const auto note = [&](bool found, const char* what) {
      if (found) mesh_.notes.add(what);
    };
    note(!model_.animations.empty(), "animations are left out");
    note(!model_.skins.empty(), "bones are left out");
    note(!model_.cameras.empty() || !model_.lights.empty(), "cameras and lights are left out");
  }

  void add_levels() {
    std::vector<int> roots = scene_roots();
    LevelOfDetail finest;
    for (const int root : roots) add_node(root, z_up(), 0, -1, finest);
    asset_.model.levels.push_back(std::move(finest));
    if (roots.size() != 1) return;
    const tinygltf::Node& node = gltf_item(model_.nodes, roots[0], "node", file_);
    asset_.model.name = node.name.empty() ? asset_.model.name : node.name;
    const Value until = node.extras.Has(kUntil) ? node.extras.Get(kUntil) : Value();
    const auto extension = node.extensions.find(kLevelsExtension);
    if (until.ArrayLen() > 0) asset_.model.levels[0].until = distance(until.Get(0));
    if (extension == node.extensions.end() || !extension->second.Has("ids")) return;
    const Value& ids = extension->second.Get("ids");
    // Without our distances only the finest level is usable.
    if (until.ArrayLen() != ids.ArrayLen() + 1) return;
    for (int i = 0; i < static_cast<int>(ids.ArrayLen()); ++i) {
      LevelOfDetail level{distance(until.Get(i + 1)), {}};
      const double last = static_cast<double>(model_.nodes.size()) - 1;
      add_node(static_cast<int>(gltf_number(ids.Get(i), kLevelsExtension, 0, last, file_)), z_up(),
               0, -1, level);
      asset_.model.levels.push_back(std::move(level));
    }
  }

  double distance(const Value& value) const { return gltf_number(value, kUntil, 0, 1e9, file_); }

  std::vector<int> scene_roots() const {
    if (!model_.scenes.empty()) {
      return gltf_item(model_.scenes, std::max(0, model_.defaultScene), "scene", file_).nodes;
    }
    std::vector<bool> is_child(model_.nodes.size());
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int child : node.children) {
        gltf_item(model_.nodes, child, "node", file_);
        is_child[static_cast<std::size_t>(child)] = true;
      }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) roots.push_back(static_cast<int>(i));
    }
    return roots;
  }

  /// `around` is the part that it is in.
  void add_node(int index, const Eigen::Matrix4f& T_model_parent, int depth, int around,
                LevelOfDetail& level) {
    constexpr int kDeepest = 64, kMost = 100000;
    if (depth > kDeepest) fail("{}: nodes lie more than {} deep in each other", file_, kDeepest);
    if (++visited_ > kMost) fail("{}: more than {} nodes", file_, kMost);
    const tinygltf::Node& node = gltf_item(model_.nodes, index, "node", file_);
    const Eigen::Matrix4f T_model_node = T_model_parent * matrix_of(node);
    const int own = mesh_.add_part(node.name, around);
    if (node.mesh >= 0) {
      const tinygltf::Mesh& mesh = gltf_item(model_.meshes, node.mesh, "mesh", file_);
      const int inner = mesh_.add_part(mesh.name, own);
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        if (lenient_ && !can_be_drawn(primitive, node, T_model_node)) continue;
        level.primitives.push_back(part(primitive, T_model_node));
        mesh_.part_of.push_back(inner);
      }
    }
    for (const int child : node.children) add_node(child, T_model_node, depth + 1, own, level);
  }

  bool can_be_drawn(const tinygltf::Primitive& primitive, const tinygltf::Node& node,
                    const Eigen::Matrix4f& T_model_node) {
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) {
      mesh_.notes.add(primitive.mode <= TINYGLTF_MODE_LINE_STRIP
                          ? "lines and points are left out"
                          : "strips and fans of triangles are left out");
      return false;
    }
    if (std::abs(T_model_node.topLeftCorner<3, 3>().determinant()) > 0) return true;
    mesh_.notes.add(fmt::format("node '{}' flattens its mesh, which is left out", node.name));
    return false;
  }

  /// tinygltf keeps the readable part of an invalid list.
  void expect_size(const std::vector<double>& numbers, std::size_t size, const char* what) const {
    if (numbers.empty() || numbers.size() == size) return;
    fail("{}: {} of {} numbers, expected {}", file_, what, numbers.size(), size);
  }

  Eigen::Matrix4f matrix_of(const tinygltf::Node& node) const {
    expect_size(node.matrix, 16, "matrix");
    expect_size(node.translation, 3, "translation");
    expect_size(node.rotation, 4, "rotation");
    expect_size(node.scale, 3, "scale");
    if (node.matrix.size() == 16) {
      return Eigen::Map<const Eigen::Matrix4d>(node.matrix.data()).cast<float>();
    }
    Eigen::Affine3d T = Eigen::Affine3d::Identity();
    if (node.translation.size() == 3) {
      T.translate(Eigen::Map<const Eigen::Vector3d>(node.translation.data()));
    }
    if (node.rotation.size() == 4) {
      T.rotate(
          Eigen::Quaterniond(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2])
              .normalized());
    }
    if (node.scale.size() == 3) T.scale(Eigen::Map<const Eigen::Vector3d>(node.scale.data()));
    return T.matrix().cast<float>();
  }

  Primitive part(const tinygltf::Primitive& from, const Eigen::Matrix4f& T_model_node) {
    if (from.mode != TINYGLTF_MODE_TRIANGLES && from.mode != -1) {
      fail("{}: a mesh of mode {}, expected triangles ({})", file_, from.mode,
           TINYGLTF_MODE_TRIANGLES);
    }
    Primitive primitive;
    primitive.material = from.material >= 0 ? from.material : default_material();
    gltf_item(asset_.materials, primitive.material, "material", file_);
    const bool has_normals = read_vertices(from, primitive);
    read_colours(from, primitive);
    read_indices(from, primitive);
    if (!has_normals) {
      mesh_.notes.add("normals are computed from the triangles, for it has none");
      compute_normals(primitive);
    }
    if (!from.targets.empty()) mesh_.notes.add("shape keys are left out");
    transform(primitive, T_model_node);
    return primitive;
  }

  /// Returns whether they have normals.
  bool read_vertices(const tinygltf::Primitive& from, Primitive& primitive) {
    const auto attribute = [&](const char* name) {
      const auto it = from.attributes.find(name);
      return it == from.attributes.end() ? -1 : it->second;
    };
    if (attribute("POSITION") < 0) fail("{}: a mesh has no positions", file_);
    const GltfNumbers positions(model_, attribute("POSITION"), TINYGLTF_TYPE_VEC3, file_);
    take(sizeof(Primitive) + positions.size() * sizeof(Vertex));
    primitive.vertices.resize(positions.size());
    const auto read = [&](const char* name, int type, auto set) {
      if (attribute(name) < 0) return false;
      const GltfNumbers numbers(model_, attribute(name), type, file_);
      name == kPart ? numbers.expect_whole(file_) : numbers.expect_real(file_);
      if (numbers.size() != positions.size()) {
        fail("{}: {} of {} vertices, expected {}", file_, name, numbers.size(), positions.size());
      }
      for (std::size_t i = 0; i < numbers.size(); ++i) set(primitive.vertices[i], numbers, i);
      return true;
    };
    read("POSITION", TINYGLTF_TYPE_VEC3, [](Vertex& v, const GltfNumbers& n, std::size_t i) {
      v.position = {n.real(i, 0), n.real(i, 1), n.real(i, 2)};
    });
    const std::string uv_set = uv_set_of(from);
    read(uv_set.c_str(), TINYGLTF_TYPE_VEC2, [](Vertex& v, const GltfNumbers& n, std::size_t i) {
      v.uv = {n.real(i, 0), n.real(i, 1)};
    });
    read(kOcclusion, TINYGLTF_TYPE_SCALAR,
         [](Vertex& v, const GltfNumbers& n, std::size_t i) { v.occlusion = n.real(i, 0); });
    read(kPart, TINYGLTF_TYPE_SCALAR, [&](Vertex& v, const GltfNumbers& n, std::size_t i) {
      if (n.whole(i) > 255) fail("{}: part {}, expected 0 to 255", file_, n.whole(i));
      v.part = static_cast<std::uint8_t>(n.whole(i));
    });
    return read("NORMAL", TINYGLTF_TYPE_VEC3, [](Vertex& v, const GltfNumbers& n, std::size_t i) {
      v.normal = {n.real(i, 0), n.real(i, 1), n.real(i, 2)};
    });
  }

  /// The attribute by which the material's image is placed.
  std::string uv_set_of(const tinygltf::Primitive& from) {
    int set = 0;
    if (from.material >= 0) {
      set = gltf_item(model_.materials, from.material, "material", file_)
                .pbrMetallicRoughness.baseColorTexture.texCoord;
    }
    std::string name = fmt::format("TEXCOORD_{}", set);
    for (const auto& [attribute, accessor] : from.attributes) {
      if (!attribute.starts_with("TEXCOORD_") || attribute == name) continue;
      mesh_.notes.add("more than one UV set: only that of the image is used");
    }
    return name;
  }

  /// Linear RGB, which multiplies that of the material.
  void read_colours(const tinygltf::Primitive& from, Primitive& primitive) {
    if (from.attributes.contains("COLOR_1")) {
      mesh_.notes.add("more than one set of vertex colours: the first is used");
    }
    const auto found = from.attributes.find("COLOR_0");
    if (found == from.attributes.end()) return;
    const int type = gltf_item(model_.accessors, found->second, "accessor", file_).type;
    const bool with_alpha = type == TINYGLTF_TYPE_VEC4;
    const GltfNumbers numbers(model_, found->second,
                              with_alpha ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, file_);
    numbers.expect_real(file_);
    if (numbers.size() != primitive.vertices.size()) {
      fail("{}: COLOR_0 of {} vertices, expected {}", file_, numbers.size(),
           primitive.vertices.size());
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      primitive.vertices[i].colour =
          vertex_colour({numbers.real(i, 0), numbers.real(i, 1), numbers.real(i, 2)});
    }
    asset_.materials[static_cast<std::size_t>(primitive.material)].vertex_colours = true;
  }

  /// Nodes may instance one mesh many times: a small file could fill the memory.
  void take(std::size_t bytes) {
    constexpr std::size_t kMost = 512;  // MiB
    taken_ += bytes;
    if (taken_ > kMost << 20) fail("{}: its meshes take more than {} MiB", file_, kMost);
  }

  void read_indices(const tinygltf::Primitive& from, Primitive& primitive) {
    if (from.indices < 0) {
      for (std::uint32_t i = 0; i < primitive.vertices.size(); ++i) primitive.indices.push_back(i);
    } else {
      const GltfNumbers numbers(model_, from.indices, TINYGLTF_TYPE_SCALAR, file_);
      take(numbers.size() * sizeof(std::uint32_t));
      numbers.expect_whole(file_);
      for (std::size_t i = 0; i < numbers.size(); ++i)
        primitive.indices.push_back(numbers.whole(i));
    }
    if (primitive.indices.size() % 3 != 0) {
      fail("{}: {} indices, expected three for each triangle", file_, primitive.indices.size());
    }
  }

  /// Exact if the node does not rotate or scale: our own files are restored bit by bit.
  void transform(Primitive& primitive, const Eigen::Matrix4f& m) const {
    const Eigen::Matrix3f turn = m.topLeftCorner<3, 3>();
    const float volume = turn.determinant();
    if (!(std::abs(volume) > 0)) fail("{}: a node flattens its mesh", file_);
    const Eigen::Matrix3f across = std::abs(volume) * turn.inverse().transpose();
    for (Vertex& vertex : primitive.vertices) {
      vertex.position = (turn * vertex.position + m.topRightCorner<3, 1>()).eval();
      vertex.normal = (across * vertex.normal).eval();
    }
    if (volume < 0) turn_over(primitive.indices);
  }

  int default_material() {
    if (default_material_ < 0) {
      default_material_ = asset_.add(make_material("default", Label::kLeaf, -1));
    }
    return default_material_;
  }

  DecodedImages& images_;
  std::string file_;
  bool lenient_ = false;
  tinygltf::Model model_;
  ImportedMesh mesh_;
  Asset& asset_ = mesh_.asset;
  int default_material_ = -1;
  int visited_ = 0;
  std::size_t taken_ = 0;  ///< bytes of memory used by the meshes so far
};

}  // namespace

ImportedMesh read_gltf(const std::string& bytes, const std::filesystem::path& file,
                       Strictness strictness, DecodedImages& images) {
  return GltfReader(bytes, file, strictness, images).read();
}

}  // namespace vinebench::sim
