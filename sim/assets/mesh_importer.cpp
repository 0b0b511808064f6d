// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/util/error.h"
#include "sim/assets/asset_file.h"
#include "sim/assets/collada_check.h"
#include "sim/assets/mesh_files.h"
#include "sim/assets/obj_check.h"

namespace vinebench::sim {
namespace {

constexpr double kMostVertices = 10e6;
constexpr float kSmoothest = 60;  // degrees; faces that meet at more have an edge

float linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

class MeshImporter {
 public:
  explicit MeshImporter(const std::filesystem::path& file) : file_(file) {
    const std::string kind = file.extension().string();
    is_collada_ = kind.size() == 4 && std::tolower(kind[1]) == 'd';
  }

  Asset read() {
    const std::string text = read_mesh_file(file_);
    check(text);
    importer_.SetIOHandler(new MeshFiles(file_.string(), text));  // owned by the importer
    importer_.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                 aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer_.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kSmoothest);
    const aiScene* scene =
        loaded(importer_.ReadFile(file_.string(), aiProcess_ValidateDataStructure));
    check_vertices(*scene);
    check_faces(*scene);
    if (vertices_below(*scene, *scene->mRootNode) > kMostVertices) {
      fail("{}: expected at most {} vertices", file_.string(), kMostVertices);
    }
    scene = loaded(importer_.ApplyPostProcessing(
        aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_GenSmoothNormals |
        aiProcess_JoinIdenticalVertices | aiProcess_PreTransformVertices));
    Asset asset;
    asset.model.name = file_.stem().string();
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) add(*scene->mMaterials[i], asset);
    LevelOfDetail level;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i)
      level.primitives.push_back(part(*scene->mMeshes[i]));
    asset.model.levels.push_back(std::move(level));
    return asset;
  }

 private:
  /// Before assimp reads it: what would crash it, or take far more memory than the file.
  void check(const std::string& text) const {
    constexpr std::size_t kLargest = std::size_t{256} << 20;
    if (text.size() > kLargest) {
      fail("{}: expected at most 256 MiB for this format, found {} bytes", file_.string(),
           text.size());
    }
    const char kind = static_cast<char>(std::tolower(file_.extension().string().at(1)));
    if (kind == 'd') check_collada(text, file_.string());
    if (kind == 'o') check_obj(text, file_.string());
  }

  const aiScene* loaded(const aiScene* scene) const {
    if (scene == nullptr || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
      fail("{}: expected a mesh: {}", file_.string(), importer_.GetErrorString());
    }
    return scene;
  }

  /// Before assimp joins vertices: it would drop a NaN vertex as equal to its neighbour.
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

  /// These formats do not define single-sided surfaces, and leaves of other tools are often single
  /// sheets.
  void add(const aiMaterial& from, Asset& asset) const {
    aiString name("material"), image;
    from.Get(AI_MATKEY_NAME, name);
    Material material = make_material(name.C_Str(), Label::kLeaf, -1);
    material.double_sided = true;
    aiColor3D colour(0.6f, 0.6f, 0.6f);
    from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    material.colour = {linear(colour.r), linear(colour.g), linear(colour.b)};
    if (from.GetTexture(aiTextureType_DIFFUSE, 0, &image) == aiReturn_SUCCESS) {
      Texture texture = load_texture(image.C_Str());
      cv::Mat alpha;
      cv::extractChannel(texture.rgba, alpha, 3);
      double lowest = 255;
      cv::minMaxLoc(alpha, &lowest);
      material.cutout = lowest < 128;
      material.texture = asset.add(std::move(texture));
    }
    asset.add(std::move(material));
  }

  Texture load_texture(std::string name) const {
    std::ranges::replace(name, '\\', '/');
    const std::filesystem::path path = file_.parent_path() / name;
    const std::string where = fmt::format("{}: image {}", file_.string(), path.string());
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) fail("{}: no such file", where);
    return {name, decode_image(read_mesh_file(path, FileKind::kImage), where), true};
  }

  Primitive part(const aiMesh& mesh) const {
    Primitive primitive;
    primitive.material = static_cast<int>(mesh.mMaterialIndex);
    const auto z_up = [&](const aiVector3D& v) {
      // Assimp converts a .dae to y up, whatever its up axis, and leaves the other formats
      // unchanged.
      return is_collada_ ? Eigen::Vector3f(v.x, -v.z, v.y) : Eigen::Vector3f(v.x, v.y, v.z);
    };
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      Vertex vertex;
      vertex.position = z_up(mesh.mVertices[i]);
      // A degenerate triangle.
      const bool has_normal = mesh.HasNormals() && std::isfinite(mesh.mNormals[i].SquareLength());
      vertex.normal = has_normal ? z_up(mesh.mNormals[i]) : Eigen::Vector3f::UnitZ();
      if (mesh.HasTextureCoords(0)) {
        vertex.uv = {mesh.mTextureCoords[0][i].x, 1 - mesh.mTextureCoords[0][i].y};
      }
      primitive.vertices.push_back(vertex);
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;
      primitive.indices.insert(primitive.indices.end(), face.mIndices, face.mIndices + 3);
    }
    return primitive;
  }

  std::filesystem::path file_;
  bool is_collada_ = false;
  Assimp::Importer importer_;
};

}  // namespace

Asset import_mesh(const std::filesystem::path& file) {
  return MeshImporter(file).read();
}

}  // namespace vinebench::sim
