// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "sim/assets/asset.h"

namespace vinebench::sim {

/// Reads a mesh of any origin: .glb and .gltf (y up, as their standard has it), .dae (as it says
/// itself), .obj and .stl (z up); m. Materials that do not say otherwise are labelled as leaves.
/// Throws Error that names the file and what is wrong with it.
Asset load_asset(const std::filesystem::path& file);

/// The asset as the bytes of a .glb file with its images inside. Viewers show its finest level;
/// load_asset brings back every level, material and bit.
std::string to_glb(const Asset& asset);

// What load_asset is made of.

Asset read_gltf(const std::filesystem::path& file);
Asset import_mesh(const std::filesystem::path& file);  ///< by assimp

/// The whole of a mesh's, an image's or a buffer's file. Throws Error when it is no file, cannot
/// be read, is empty or larger than 1 GiB.
std::string read_mesh_file(const std::filesystem::path& file);

/// An image file's bytes as the pixels of a Texture. Throws Error that names `where`, also
/// for an image of more than 16384 pixels on a side or 2^24 in all.
cv::Mat decode_image(std::string_view bytes, const std::string& where);

/// Normals from the triangles around each vertex, weighted by their areas.
void compute_normals(Primitive& primitive);

}  // namespace vinebench::sim
