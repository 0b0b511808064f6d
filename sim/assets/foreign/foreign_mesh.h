// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "sim/assets/foreign/mesh_import.h"

namespace vinebench::sim {

/// Reads mesh files of other tools, m, z up, and labels their parts. Primitives of one material are
/// joined; each part that is labelled as a bunch has a number of its own (Vertex::part). Warns once
/// a file of what is not drawn of it. What has no label by `import` has `label`, or without one the
/// file's own, else leaf.
///
/// Throws Error with file and reason for a file that cannot be read, and for a name of
/// `import.labels` that none of the files has, with the nearest one; `key` is where it stands.
std::vector<Asset> load_foreign_meshes(const std::vector<std::filesystem::path>& files,
                                       const MeshImport& import, std::optional<Label> label,
                                       const std::string& key);

}  // namespace vinebench::sim
