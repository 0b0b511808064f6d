// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace vinebench::sim {

/// Which platform gives the OpenGL context. Both give the same image; `auto` takes OSMesa where it
/// was built, else EGL.
enum class GlBackend { kAuto, kOsmesa, kEgl };

inline std::vector<std::string> yaml_names(GlBackend) {
  return {"auto", "osmesa", "egl"};
}

}  // namespace vinebench::sim
