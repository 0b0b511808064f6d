// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "sim/assets/gltf.h"

namespace vinebench::sim {

/// The parts of a .glb or .gltf file with its buffers; images stay as the bytes of their files.
/// References between the parts are not checked. Throws Error that names the file.
tinygltf::Model parse_gltf(const std::filesystem::path& file);

}  // namespace vinebench::sim
