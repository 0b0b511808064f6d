// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "sim/assets/asset.h"

namespace vinebench::sim {

/// Reads a mesh file: .glb and .gltf (y up, by their standard), .dae (up axis of the file), .obj
/// and .stl (z up); m. Materials without a label are labelled as leaves. Throws Error with file and
/// reason.
Asset load_asset(const std::filesystem::path& file);

/// The same of a .glb file's bytes that are in memory already; `file` is its name.
Asset asset_of_glb(const std::string& bytes, const std::filesystem::path& file);

/// The asset as the bytes of a .glb file with its images inside. Viewers show its finest level;
/// load_asset restores all levels and materials exactly.
std::string to_glb(const Asset& asset);

// Parts of load_asset.

Asset read_gltf(const std::string& bytes, const std::filesystem::path& file);
Asset import_mesh(const std::filesystem::path& file);  ///< with assimp

/// The content of a mesh, image or buffer file. Throws Error if it is not a file, cannot be read,
/// is empty or larger than 1 GiB.
std::string read_mesh_file(const std::filesystem::path& file);

/// Decodes an image file to the pixels of a Texture. Throws Error that names `where`, also for an
/// image of more than 16384 pixels on a side or 2^24 in all.
cv::Mat decode_image(std::string_view bytes, const std::string& where);

/// Normals from the triangles around each vertex, weighted by their areas.
void compute_normals(Primitive& primitive);

}  // namespace vinebench::sim
