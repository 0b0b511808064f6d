// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/assets/asset_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/files/files.h"
#include "core/files/image_size.h"
#include "core/util/error.h"

namespace vinebench::sim {
namespace {

std::string problem_of(const Vertex& v) {
  if (!v.position.allFinite() || !v.uv.allFinite() || !v.normal.allFinite() ||
      !std::isfinite(v.occlusion)) {
    return "is not a finite number";
  }
  if (v.position.cwiseAbs().maxCoeff() <= kFarthestVertex) return "";
  return fmt::format("lies more than {} m from the origin", kFarthestVertex);
}

void check(const Primitive& primitive, std::size_t materials, const std::string& file) {
  for (std::size_t i = 0; i < primitive.vertices.size(); ++i) {
    const std::string problem = problem_of(primitive.vertices[i]);
    if (!problem.empty()) fail("{}: vertex {} {}", file, i, problem);
  }
  for (const std::uint32_t index : primitive.indices) {
    if (index >= primitive.vertices.size()) {
      fail("{}: a triangle names vertex {} of {}", file, index, primitive.vertices.size());
    }
  }
  if (primitive.material < 0 || static_cast<std::size_t>(primitive.material) >= materials) {
    fail("{}: names material {} of {}", file, primitive.material, materials);
  }
}

void check(const Material& material, std::size_t textures, const std::string& file) {
  if (!material.colour.allFinite() || material.colour.minCoeff() < 0 ||
      material.colour.maxCoeff() > 1) {
    fail("{}: material '{}': expected a colour of numbers from 0 to 1", file, material.name);
  }
  if (material.texture < -1 || material.texture >= static_cast<int>(textures)) {
    fail("{}: names texture {} of {}", file, material.texture, textures);
  }
}

void check(const Asset& asset, const std::string& file) {
  for (const Material& material : asset.materials) check(material, asset.textures.size(), file);
  for (const LevelOfDetail& level : asset.model.levels) {
    for (const Primitive& primitive : level.primitives) {
      check(primitive, asset.materials.size(), file);
    }
    if (triangle_count(level) == 0) fail("{}: expected a mesh, found no triangles", file);
  }
  if (asset.model.levels.empty()) fail("{}: expected a mesh, found no triangles", file);
}

/// Normals of imported meshes are rarely normalised exactly; ours are unchanged.
void normalise(Asset& asset) {
  for (LevelOfDetail& level : asset.model.levels) {
    for (Primitive& primitive : level.primitives) {
      for (Vertex& vertex : primitive.vertices) {
        const float length = vertex.normal.stableNorm();
        if (length < 1e-6f || !std::isfinite(length)) {
          vertex.normal = Eigen::Vector3f::UnitZ();
        } else if (std::abs(length - 1) > 1e-4f) {
          vertex.normal /= length;
        }
      }
    }
  }
}

}  // namespace

namespace {

constexpr const char* kImages = "expected an image (PNG, JPEG, TIFF)";

/// A small file can require gigabytes of pixels.
void check_size(std::string_view bytes, const std::string& where) {
  constexpr double kLargest = 16384, kMost = 1 << 24;  // px, on a side and in all
  const std::optional<cv::Size2d> size = image_size(bytes);
  if (!size) fail("{}: {}, found something else", where, kImages);
  if (size->width >= 1 && size->height >= 1 && std::max(size->width, size->height) <= kLargest &&
      size->area() <= kMost) {
    return;
  }
  fail("{}: expected an image of 1 to {} pixels a side and {} in all, found {} x {}", where,
       kLargest, kMost, size->width, size->height);
}

cv::Mat decode(std::string_view bytes) {
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  cv::Mat image = cv::imdecode(raw, cv::IMREAD_UNCHANGED);
  if (image.depth() == CV_16U) image.convertTo(image, CV_8U, 1 / 257.0);
  if (image.empty() || image.depth() != CV_8U) return {};
  cv::Mat rgba;
  const int channels = image.channels();
  cv::cvtColor(image, rgba,
               channels == 4   ? cv::COLOR_BGRA2RGBA
               : channels == 3 ? cv::COLOR_BGR2RGBA
                               : cv::COLOR_GRAY2RGBA);
  return rgba;
}

}  // namespace

std::string read_mesh_file(const std::filesystem::path& file, FileKind kind) {
  std::string bytes = read_file(file, kind);
  if (bytes.empty()) fail("{}: expected a mesh or its parts, found an empty file", file.string());
  return bytes;
}

cv::Mat decode_image(std::string_view bytes, const std::string& where) {
  check_size(bytes, where);
  cv::Mat rgba;
  try {
    rgba = decode(bytes);
  } catch (const cv::Exception&) {
    rgba.release();
  }
  if (rgba.empty()) fail("{}: {} of 8 or 16 bits a channel, found a broken one", where, kImages);
  return rgba;
}

cv::Mat DecodedImages::decode(std::string_view bytes, const std::string& where) {
  const auto known = images_.find(bytes);
  if (known != images_.end()) return known->second;
  return images_.emplace(bytes, decode_image(bytes, where)).first->second;
}

void compute_normals(Primitive& primitive) {
  for (Vertex& vertex : primitive.vertices) vertex.normal.setZero();
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const std::uint32_t* corner = &primitive.indices[i];
    const auto size = primitive.vertices.size();
    if (corner[0] >= size || corner[1] >= size || corner[2] >= size) continue;
    const Eigen::Vector3f& a = primitive.vertices[corner[0]].position;
    const Eigen::Vector3f across = (primitive.vertices[corner[1]].position - a)
                                       .cross(primitive.vertices[corner[2]].position - a);
    for (int k = 0; k < 3; ++k) primitive.vertices[corner[k]].normal += across;
  }
  for (Vertex& vertex : primitive.vertices) vertex.normal.stableNormalize();
}

Eigen::Vector3f linear_colour(const std::array<std::uint8_t, 3>& vertex_colour) {
  Eigen::Vector3f linear;
  for (int i = 0; i < 3; ++i) {
    linear[i] =
        std::pow(static_cast<float>(vertex_colour.at(static_cast<std::size_t>(i))) / 255.0f, 2.2f);
  }
  return linear;
}

std::array<std::uint8_t, 3> vertex_colour(const Eigen::Vector3f& linear) {
  std::array<std::uint8_t, 3> bytes{};
  for (int i = 0; i < 3; ++i) {
    // Not std::clamp: a NaN becomes 0.
    const float share = std::min(1.0f, std::max(0.0f, linear[i]));
    bytes[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::lround(255 * std::pow(share, 1 / 2.2f)));
  }
  return bytes;
}

namespace {

ImportedMesh sound(ImportedMesh mesh, const std::filesystem::path& file) {
  check(mesh.asset, file.string());
  normalise(mesh.asset);
  mesh.asset.update_bounds();
  return mesh;
}

}  // namespace

Asset asset_of_glb(const std::string& bytes, const std::filesystem::path& file,
                   DecodedImages& images) {
  return sound(read_gltf(bytes, file, Strictness::kStrict, images), file).asset;
}

Asset load_asset(const std::filesystem::path& file) {
  return load_mesh(file, Strictness::kStrict).asset;
}

ImportedMesh load_mesh(const std::filesystem::path& file, Strictness strictness) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return std::tolower(c); });
  if (extension == ".glb" || extension == ".gltf") {
    DecodedImages images;
    return sound(read_gltf(read_mesh_file(file), file, strictness, images), file);
  }
  if (extension == ".obj" || extension == ".stl" || extension == ".dae") {
    return sound(import_mesh(file, strictness), file);
  }
  fail("{}: expected a mesh of .glb, .gltf, .obj, .stl or .dae", file.string());
}

}  // namespace vinebench::sim
