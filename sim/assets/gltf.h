// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// tinygltf as Debian builds it: without its own image decoder.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#include <tiny_gltf.h>

namespace vinebench::sim {

// Levels of detail: a viewer shows the node of the scene; this extension names the others.
inline constexpr const char* kLevelsExtension = "MSFT_lod";
// Data without a glTF representation. Extras of the finest level's node: the distance up to which
// each level is drawn, m.
inline constexpr const char* kUntil = "until";
// Extras of a material; the label by its name.
inline constexpr const char* kLabel = "label";
inline constexpr const char* kTranslucency = "translucency";
// Attributes of a vertex.
inline constexpr const char* kOcclusion = "_OCCLUSION";
inline constexpr const char* kPart = "_PART";

}  // namespace vinebench::sim
