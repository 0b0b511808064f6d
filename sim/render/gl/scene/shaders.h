// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vinebench::sim {

// Attributes and uniforms are those of mesh_shaders.h.

/// Depth as the sun sees it.
std::string shadow_vertex_shader();
std::string shadow_fragment_shader(bool cutout);

/// The image's full width behind everything, from the first to the second of the clip space's y in
/// `rows`.
std::string sky_vertex_shader();
std::string sky_fragment_shader();

/// Pieces of wire as strips that face the camera, one pixel wider than the wire; a pixel is covered
/// by the share of its width that the wire takes. For the truth a wire is where it covers half a
/// pixel.
std::string wire_vertex_shader();
std::string wire_fragment_shader(bool truth);

}  // namespace vinebench::sim
