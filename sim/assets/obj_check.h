// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace vinebench::sim {

/// Throws Error that names `file` for the text of an .obj that would make assimp crash or use
/// memory beyond measure: bytes that are no text, such as UTF-16, and more than 10 million vertices
/// or corners of faces.
void check_obj(std::string_view text, const std::string& file);

/// The same for a library of materials (.mtl), with the line: bytes that are no text, and
/// properties before the first material.
void check_mtl(std::string_view text, const std::string& file);

}  // namespace vinebench::sim
