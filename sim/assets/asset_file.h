// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "core/files/input_file.h"
#include "sim/assets/asset.h"
#include "sim/assets/imported_mesh.h"

namespace vinebench::sim {

inline constexpr float kFarthestVertex = 1e5f;  ///< m, along an axis from a mesh's origin

/// Reads a mesh file: .glb and .gltf (y up, by their standard), .dae (up axis of the file), .obj
/// and .stl (z up); m. Materials without a label are labelled as leaves. Throws Error with file and
/// reason.
Asset load_asset(const std::filesystem::path& file);

/// The same with the names of its parts. Unless it is strict, an image that is missing or broken
/// and whatever else a mesh can be drawn without is noted in place of an Error.
ImportedMesh load_mesh(const std::filesystem::path& file, Strictness strictness);

/// Images by the bytes of their files, so that one that several meshes share is decoded once.
class DecodedImages {
 public:
  /// decode_image, or the same pixels as the last time: not to be changed.
  cv::Mat decode(std::string_view bytes, const std::string& where);

 private:
  std::map<std::string, cv::Mat, std::less<>> images_;
};

/// The same of a .glb file's bytes that are in memory already; `file` is its name.
Asset asset_of_glb(const std::string& bytes, const std::filesystem::path& file,
                   DecodedImages& images);

/// The asset as the bytes of a .glb file with its images inside. Viewers show its finest level;
/// load_asset restores all levels and materials exactly, but for colours of vertices.
std::string to_glb(const Asset& asset);

/// A level of detail of a model of a scene, somewhere in the world.
struct PlacedMesh {
  int model = 0;  ///< index into Scene::models
  int level = 0;
  Pose T_world_model;
  float scale = 1;
};

/// The placed meshes with all textures and materials of the scene as the bytes of a .glb file: a
/// node each, those of one level share their mesh. Meshes without triangles are left out.
std::string to_glb(const Scene& scene, const std::vector<PlacedMesh>& placed);

// Parts of load_mesh.

/// Of a .glb's or .gltf's bytes; `file` is its name.
ImportedMesh read_gltf(const std::string& bytes, const std::filesystem::path& file,
                       Strictness strictness, DecodedImages& images);
/// With assimp. Equal vertices are joined. Where there are no normals, and for .stl, they are
/// computed; edges of more than 60 degrees stay sharp.
ImportedMesh import_mesh(const std::filesystem::path& file, Strictness strictness);

/// The content of a mesh, image or buffer file. Throws Error if it is not a file, cannot be read,
/// is empty or larger than its kind may be.
std::string read_mesh_file(const std::filesystem::path& file, FileKind kind = FileKind::kMesh);

/// Decodes an image file to the pixels of a Texture. Throws Error that names `where`, also for an
/// image of more than 16384 pixels on a side or 2^24 in all.
cv::Mat decode_image(std::string_view bytes, const std::string& where);

/// Vertex::colour of linear RGB, 0 to 1, and back: every byte comes back as it was.
std::array<std::uint8_t, 3> vertex_colour(const Eigen::Vector3f& linear);
Eigen::Vector3f linear_colour(const std::array<std::uint8_t, 3>& vertex_colour);

/// Normals from the triangles around each vertex, weighted by their areas.
void compute_normals(Primitive& primitive);

}  // namespace vinebench::sim
