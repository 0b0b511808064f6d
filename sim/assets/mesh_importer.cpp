// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "core/util/error.h"
#include "sim/assets/asset_file.h"
#include "sim/assets/collada_check.h"
#include "sim/assets/geometry/smooth_normals.h"
#include "sim/assets/geometry/weld_table.h"
#include "sim/assets/mesh_files.h"
#include "sim/assets/mesh_text.h"
#include "sim/assets/obj_check.h"

namespace vinebench::sim {
namespace {

constexpr double kMostVertices = 10e6;
/// Faces that meet at more have an edge.
constexpr float kSharpest = 60 * std::numbers::pi_v<float> / 180;

float linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

Eigen::Vector3f vector_of(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

class MeshImporter {
 public:
  MeshImporter(const std::filesystem::path& file, Strictness strictness)
      : file_(file), strictness_(strictness) {
    std::string kind = file.extension().string();
    std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return std::tolower(c); });
    is_collada_ = kind == ".dae";
    is_stl_ = kind == ".stl";
  }

  ImportedMesh read() {
    const std::string text = read_mesh_file(file_);
    check(text);
    importer_.SetIOHandler(new MeshFiles(file_.string(), text));  // owned by the importer
    // Names rather than identifiers, which exporters make up from them.
    importer_.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
    importer_.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                 aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* scene =
        loaded(importer_.ReadFile(file_.string(), aiProcess_ValidateDataStructure));
    check_vertices(*scene);
    check_faces(*scene);
    if (vertices_below(*scene, *scene->mRootNode) > kMostVertices) {
      fail("{}: expected at most {} vertices", file_.string(), kMostVertices);
    }
    note_contents(*scene);
    scene = loaded(importer_.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_SortByPType));
    asset().model.name = file_.stem().string();
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) add(*scene->mMaterials[i]);
    asset().model.levels.emplace_back();
    add_node(*scene, *scene->mRootNode, aiMatrix4x4(), -1);
    return std::move(mesh_);
  }

 private:
  Asset& asset() { return mesh_.asset; }

  /// Before assimp reads it: what would crash it, or take far more memory than the file.
  void check(const std::string& text) {
    constexpr std::size_t kLargest = std::size_t{256} << 20;
    if (text.size() > kLargest) {
      fail("{}: expected at most 256 MiB for this format, found {} bytes", file_.string(),
           text.size());
    }
    if (is_collada_) {
      check_collada(text, file_.string());
      mesh_.up_axis = collada_up_axis(text);
    } else if (!is_stl_) {
      check_obj(text, file_.string());
      for (const std::string& library : missing_material_libraries(text, file_.parent_path())) {
        mesh_.notes.add(fmt::format("material library {}: no such file", library));
      }
    }
  }

  const aiScene* loaded(const aiScene* scene) const {
    if (scene == nullptr || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
      fail("{}: expected a mesh: {}", file_.string(), importer_.GetErrorString());
    }
    return scene;
  }

  /// Before vertices are joined: a NaN is equal to none.
  void check_vertices(const aiScene& scene) const {
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[i];
      for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        if (!std::isfinite(mesh.mVertices[v].SquareLength())) {
          fail("{}: vertex {} is not a finite number", file_.string(), v);
        }
      }
    }
  }

  /// Assimp's time to divide a polygon grows with the square of its corners, or faster.
  void check_faces(const aiScene& scene) const {
    constexpr unsigned kMostCorners = 1000;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[i];
      for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const unsigned corners = mesh.mFaces[f].mNumIndices;
        if (corners <= kMostCorners) continue;
        fail("{}: expected polygons of at most {} corners, found {}", file_.string(), kMostCorners,
             corners);
      }
    }
  }

  /// For all meshes of the nodes; nodes may instance one mesh many times.
  static double vertices_below(const aiScene& scene, const aiNode& node) {
    double count = 0;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      count += scene.mMeshes[node.mMeshes[i]]->mNumVertices;
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      count += vertices_below(scene, *node.mChildren[i]);
    }
    return count;
  }

  /// What is not drawn of the scene, before points and lines are removed.
  void note_contents(const aiScene& scene) {
    const auto note = [&](bool found, const char* text) {
      if (found) mesh_.notes.add(text);
    };
    note(scene.HasAnimations(), "animations are left out");
    note(scene.HasCameras() || scene.HasLights(), "cameras and lights are left out");
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[i];
      constexpr unsigned kThin = aiPrimitiveType_POINT | aiPrimitiveType_LINE;
      note((mesh.mPrimitiveTypes & kThin) != 0, "lines and points are left out");
      note(mesh.HasBones() || mesh.mNumAnimMeshes > 0, "bones and shape keys are left out");
      note(mesh.GetNumUVChannels() > 1, "more than one UV set: only that of the image is used");
      note(mesh.GetNumColorChannels() > 1,
           "more than one set of vertex colours: the first is used");
    }
  }

  void add(const aiMaterial& from) {
    aiString name("material");
    from.Get(AI_MATKEY_NAME, name);
    Material material = make_material(name.C_Str(), Label::kLeaf, -1);
    // These formats do not define single-sided surfaces, and leaves of other tools are often single
    // sheets.
    material.double_sided = true;
    aiColor3D colour(0.6f, 0.6f, 0.6f);
    from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    material.colour = {linear(colour.r), linear(colour.g), linear(colour.b)};
    int uv_set = 0;
    from.Get(AI_MATKEY_UVWSRC(aiTextureType_DIFFUSE, 0), uv_set);
    uv_sets_.push_back(uv_set);
    add_texture(from, material);
    note_looks(from, material.name);
    asset().add(std::move(material));
  }

  void add_texture(const aiMaterial& from, Material& material) {
    aiString image;
    if (from.GetTexture(aiTextureType_DIFFUSE, 0, &image) != aiReturn_SUCCESS) return;
    Texture texture;
    try {
      texture = load_texture(image.C_Str());
    } catch (const Error& error) {
      if (strictness_ == Strictness::kStrict) throw;
      const std::string own = file_.string() + ": ";
      const std::string text = error.what();
      mesh_.notes.add(fmt::format("material '{}' is drawn in its colour alone: {}", material.name,
                                  text.starts_with(own) ? text.substr(own.size()) : text));
      return;
    }
    cv::Mat alpha;
    cv::extractChannel(texture.rgba, alpha, 3);
    double lowest = 255;
    cv::minMaxLoc(alpha, &lowest);
    material.cutout = lowest < 128;
    material.texture = asset().add(std::move(texture));
  }

  void note_looks(const aiMaterial& from, const std::string& name) {
    constexpr std::array kOthers{
        std::pair(aiTextureType_NORMALS, "normals"), std::pair(aiTextureType_HEIGHT, "bumps"),
        std::pair(aiTextureType_SPECULAR, "gloss"), std::pair(aiTextureType_EMISSIVE, "emission"),
        std::pair(aiTextureType_OPACITY, "opacity")};
    for (const auto& [type, kind] : kOthers) {
      if (from.GetTextureCount(type) == 0) continue;
      mesh_.notes.add(fmt::format("material '{}': its image of {} is left out", name, kind));
    }
    float opacity = 1;
    if (from.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && opacity < 1) {
      mesh_.notes.add(fmt::format("material '{}' is drawn opaque", name));
    }
  }

  /// An image by its path, else by its name beside the mesh: exporters write paths of their own
  /// machine.
  Texture load_texture(std::string name) const {
    std::ranges::replace(name, '\\', '/');
    std::filesystem::path path = file_.parent_path() / name;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
      const auto beside = file_.parent_path() / std::filesystem::path(name).filename();
      if (std::filesystem::is_regular_file(beside, ignored)) path = beside;
    }
    const std::string where = fmt::format("{}: image {}", file_.string(), path.string());
    if (!std::filesystem::is_regular_file(path, ignored)) fail("{}: no such file", where);
    return {name, decode_image(read_mesh_file(path, FileKind::kImage), where), true};
  }

  void add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& T_root_parent,
                int around) {
    const aiMatrix4x4 T_root_node = T_root_parent * node.mTransformation;
    const int own = mesh_.add_part(node.mName.C_Str(), around);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
      if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) continue;
      asset().model.levels[0].primitives.push_back(part(mesh, T_root_node));
      mesh_.part_of.push_back(mesh_.add_part(mesh.mName.C_Str(), own));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      add_node(scene, *node.mChildren[i], T_root_node, own);
    }
  }

  /// Assimp converts a .dae to y up, whatever its up axis, and leaves the other formats unchanged.
  Eigen::Vector3f z_up(const aiVector3D& v) const {
    return is_collada_ ? Eigen::Vector3f(v.x, -v.z, v.y) : vector_of(v);
  }

  Primitive part(const aiMesh& mesh, const aiMatrix4x4& T_root_node) {
    const std::vector<std::uint32_t> corners = corners_of(mesh);
    const CornerNormals computed = computed_normals(mesh, corners);
    if (mesh.HasVertexColors(0)) asset().materials.at(mesh.mMaterialIndex).vertex_colours = true;
    const aiMatrix3x3 turn(T_root_node);
    const aiMatrix3x3 across = aiMatrix3x3(turn).Inverse().Transpose();
    Primitive primitive;
    primitive.material = static_cast<int>(mesh.mMaterialIndex);
    primitive.indices.reserve(corners.size());
    WeldTable<Vertex> vertices;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      Vertex vertex = vertex_of(mesh, corners[i]);
      // Zero and minus zero are one place.
      vertex.position = z_up(T_root_node * mesh.mVertices[corners[i]]) + Eigen::Vector3f::Zero();
      const Eigen::Vector3f normal = computed.normals.empty()
                                         ? vector_of(mesh.mNormals[corners[i]])
                                         : computed.normals[computed.of_corner[i]];
      vertex.normal = z_up(across * aiVector3D(normal.x(), normal.y(), normal.z()));
      // A degenerate triangle.
      if (!vertex.normal.allFinite()) vertex.normal = Eigen::Vector3f::UnitZ();
      primitive.indices.push_back(vertices.index_of(vertex));
    }
    primitive.vertices = vertices.take();
    if (turn.Determinant() < 0) turn_over(primitive.indices);
    return primitive;
  }

  /// The file's vertices, three for each triangle.
  static std::vector<std::uint32_t> corners_of(const aiMesh& mesh) {
    std::vector<std::uint32_t> corners;
    corners.reserve(3 * std::size_t{mesh.mNumFaces});
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;
      corners.insert(corners.end(), face.mIndices, face.mIndices + 3);
    }
    return corners;
  }

  /// Empty where those of the file are used. An .stl has the normals of its flat facets, which its
  /// corners give too.
  CornerNormals computed_normals(const aiMesh& mesh, const std::vector<std::uint32_t>& corners) {
    if (mesh.HasNormals() && !is_stl_) return {};
    mesh_.notes.add(is_stl_ ? "normals are computed smooth, in place of its flat facets'"
                            : "normals are computed from the triangles, for it has none");
    const auto position = [&](std::size_t i) { return vector_of(mesh.mVertices[corners[i]]); };
    return smooth_normals(corners.size(), position, kSharpest);
  }

  /// Without its place and normal.
  Vertex vertex_of(const aiMesh& mesh, std::uint32_t index) const {
    Vertex vertex;
    const auto wanted = static_cast<unsigned>(uv_sets_.at(mesh.mMaterialIndex));
    const unsigned set = mesh.HasTextureCoords(wanted) ? wanted : 0;
    if (mesh.HasTextureCoords(set)) {
      const aiVector3D& uv = mesh.mTextureCoords[set][index];
      vertex.uv = {uv.x, 1 - uv.y};
    }
    if (mesh.HasVertexColors(0)) {
      const aiColor4D& colour = mesh.mColors[0][index];
      vertex.colour = vertex_colour({linear(colour.r), linear(colour.g), linear(colour.b)});
    }
    return vertex;
  }

  std::filesystem::path file_;
  Strictness strictness_;
  bool is_collada_ = false;
  bool is_stl_ = false;
  Assimp::Importer importer_;
  ImportedMesh mesh_;
  std::vector<int> uv_sets_;  ///< of each material's image
};

}  // namespace

ImportedMesh import_mesh(const std::filesystem::path& file, Strictness strictness) {
  return MeshImporter(file, strictness).read();
}

}  // namespace vinebench::sim
