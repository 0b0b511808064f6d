// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vinebench::sim {

/// What a mesh's shader has to do; fragments are the cost of software rendering, so each material
/// gets the leanest one.
struct MeshShader {
  /// Where the sunlight that arrives is looked up.
  enum class Shadows {
    kVertices,  ///< leaves and the like: small enough to be lit or shaded by their vertices
    kPixels,    ///< large even faces show the edge of a shadow
    kLightMap   ///< the ground: its light is baked into a map, seen from above
  };
  bool textured = false;
  bool cutout = false;  ///< discards where the texture's alpha is below one half
  Shadows shadows = Shadows::kVertices;
  bool haze = false;
  bool wind = false;
  bool truth = false;     ///< also writes instance, part, normal and motion
  bool baking = false;    ///< draws the light map itself: light alone, from above
  bool moving = false;    ///< the shadow of what moves may fall on it
  bool coloured = false;  ///< multiplies the vertices' own colours
  bool open = false;      ///< ground beyond the light map

  /// Different for different shaders.
  int key() const {
    return (textured ? 1 : 0) | (cutout ? 2 : 0) | static_cast<int>(shadows) << 2 |
           (haze ? 16 : 0) | (wind ? 32 : 0) | (truth ? 64 : 0) | (baking ? 128 : 0) |
           (moving ? 256 : 0) | (coloured ? 512 : 0) | (open ? 1024 : 0);
  }
};

// Attributes of a mesh: 0 position, 1 normal, 2 texture coordinates, 3 occlusion, 8 part, 9 colour,
// and for each instance 4 to 6 the rows of the matrix that takes the model to the camera (or the
// light), 7 its number. All shaders share the uniform block View; its layout is ViewBlock's.

/// Lights in the vertices. Light enters the image by c = texture * encode(light): with sRGB taken
/// as the power 2.2, encode(a * b) = encode(a) * encode(b), so no pixel needs a power function.
std::string mesh_vertex_shader(const MeshShader& shader);
std::string mesh_fragment_shader(const MeshShader& shader);

}  // namespace vinebench::sim
