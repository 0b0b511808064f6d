// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/util/error.h"
#include "sim/assets/asset_file.h"
#include "sim/assets/gltf.h"
#include "sim/assets/imported_mesh.h"

namespace vinebench::sim {

/// Adds the materials of a glTF file to `mesh`, with the images of their base colours. Throws Error
/// that names `file`. If it is not strict, images are read when a material asks for them, and one
/// that cannot be read is noted; other parts of a material that are not drawn are noted too.
void read_gltf_materials(const tinygltf::Model& model, const std::string& file,
                         Strictness strictness, DecodedImages& images, ImportedMesh& mesh);

/// A number within bounds; `what` names it. Throws Error that names `file`.
double gltf_number(const tinygltf::Value& value, const char* what, double least, double most,
                   const std::string& file);

/// The item of that index; `what` names it. Throws Error that names `file`.
template <class T>
const T& gltf_item(const std::vector<T>& items, int index, const char* what,
                   const std::string& file) {
  if (index < 0 || static_cast<std::size_t>(index) >= items.size()) {
    fail("{}: names {} {} of {}", file, what, index, items.size());
  }
  return items[static_cast<std::size_t>(index)];
}

}  // namespace vinebench::sim
