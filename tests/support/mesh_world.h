// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/support/test_folder.h"

namespace vinebench::test {

/// A world without generated plants: in a row along y = 2 m stand two triangles of a mesh.
inline std::filesystem::path write_mesh_world(const TestFolder& folder) {
  folder.write("vine.obj", "v -0.4 0 0\nv 0.4 0 0\nv 0 0 1.5\nf 1 2 3\n");
  return folder.write("world.yaml",
                      "name: triangles\n"
                      "ground_size: 8\n"
                      "rows: [{start: [-1, 2], end: [1, 2]}]\n"
                      "vines: {meshes: [vine.obj]}\n"
                      "tags: [{id: 3, position: [0.5, 1.5, 0.5], facing_deg: -90}]\n");
}

}  // namespace vinebench::test
