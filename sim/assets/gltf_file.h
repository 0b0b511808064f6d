// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "sim/assets/gltf.h"

namespace vinebench::sim {

/// The parts of a .glb or .gltf file of these bytes with its buffers, which are looked for beside
/// it; images stay as the bytes of their files. References between the parts are not checked.
/// Throws Error that names the file.
tinygltf::Model parse_gltf(const std::string& bytes, const std::filesystem::path& file);

}  // namespace vinebench::sim
