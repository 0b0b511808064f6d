// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vinebench {

/// What a mesh's shader has to do; fragments are the cost of software rendering, so each material
/// gets the leanest one.
struct MeshShader {
  bool textured = false;
  bool cutout = false;         ///< discards where the texture's alpha is below one half
  bool pixel_shadows = false;  ///< looks the shadow up at each pixel, else at each vertex

  int key() const { return (textured ? 1 : 0) | (cutout ? 2 : 0) | (pixel_shadows ? 4 : 0); }
};

// Attributes of a mesh: 0 position, 1 normal, 2 texture coordinates, 3 occlusion, and for each
// instance 4 to 6 the rows of the matrix that takes the model to the camera (or the light).

/// Lights in the vertices. Light enters the picture by c = texture * encode(light): with sRGB taken
/// as the power 2.2, encode(a * b) = encode(a) * encode(b), so no pixel needs a power function.
std::string mesh_vertex_shader(const MeshShader& shader);
std::string mesh_fragment_shader(const MeshShader& shader);

/// Depth as the sun sees it.
std::string shadow_vertex_shader();
std::string shadow_fragment_shader(bool cutout);

/// One triangle over the whole picture, behind everything.
std::string sky_vertex_shader();
std::string sky_fragment_shader();

/// Pieces of wire as strips that face the camera, one pixel wider than the wire; a pixel is covered
/// by the share of its width that the wire takes.
std::string wire_vertex_shader();
std::string wire_fragment_shader();

}  // namespace vinebench
