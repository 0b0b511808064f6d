// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/asset_file.h"

#include <algorithm>
#include <cctype>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "slam/base/error.h"

namespace vinebench {
namespace {

void check_primitive(const Primitive& primitive, const std::string& file) {
  for (std::size_t i = 0; i < primitive.vertices.size(); ++i) {
    const Vertex& v = primitive.vertices[i];
    if (!v.position.allFinite() || !v.uv.allFinite() || !v.normal.allFinite()) {
      fail("{}: vertex {} is not a finite number", file, i);
    }
  }
  for (const std::uint32_t index : primitive.indices) {
    if (index >= primitive.vertices.size()) {
      fail("{}: a triangle names vertex {} of {}", file, index, primitive.vertices.size());
    }
  }
}

void check(const Asset& asset, const std::string& file) {
  for (const LevelOfDetail& level : asset.model.levels) {
    for (const Primitive& primitive : level.primitives) check_primitive(primitive, file);
    if (triangle_count(level) == 0) fail("{}: expected a mesh, found no triangles", file);
  }
  if (asset.model.levels.empty()) fail("{}: expected a mesh, found no triangles", file);
}

/// Foreign normals are seldom exactly of length one; ours stay as they are.
void normalise(Asset& asset) {
  for (LevelOfDetail& level : asset.model.levels) {
    for (Primitive& primitive : level.primitives) {
      for (Vertex& vertex : primitive.vertices) {
        const float length = vertex.normal.norm();
        if (length < 1e-6f) {
          vertex.normal = Eigen::Vector3f::UnitZ();
        } else if (std::abs(length - 1) > 1e-4f) {
          vertex.normal /= length;
        }
      }
    }
  }
}

}  // namespace

cv::Mat decode_picture(std::string_view bytes, const std::string& where) {
  cv::Mat picture;
  try {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    if (!bytes.empty()) picture = cv::imdecode(raw, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    picture.release();
  }
  if (picture.empty())
    fail("{}: expected a picture (PNG, JPEG, TIFF), found something else", where);
  if (picture.depth() == CV_16U) picture.convertTo(picture, CV_8U, 1 / 257.0);
  if (picture.depth() != CV_8U) fail("{}: expected a picture of 8 or 16 bits a channel", where);
  cv::Mat rgba;
  const int channels = picture.channels();
  cv::cvtColor(picture, rgba,
               channels == 4   ? cv::COLOR_BGRA2RGBA
               : channels == 3 ? cv::COLOR_BGR2RGBA
                               : cv::COLOR_GRAY2RGBA);
  return rgba;
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

Asset load_asset(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return std::tolower(c); });
  Asset asset;
  if (extension == ".glb" || extension == ".gltf") {
    asset = read_gltf(file);
  } else if (extension == ".obj" || extension == ".stl" || extension == ".dae") {
    asset = import_mesh(file);
  } else {
    fail("{}: expected a mesh of .glb, .gltf, .obj, .stl or .dae", file.string());
  }
  check(asset, file.string());
  normalise(asset);
  asset.update_bounds();
  return asset;
}

}  // namespace vinebench
