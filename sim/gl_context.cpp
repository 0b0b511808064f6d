// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/gl_context.h"

#include <cstdlib>
#include <mutex>
#include <string>

#include "sim/gl.h"
#include "slam/base/error.h"

namespace vinebench {

GlFunctions gl;

namespace {

template <class Pointer>
void load(const GlContext& context, const char* name, Pointer& pointer) {
  pointer = reinterpret_cast<Pointer>(context.function(name));
  if (pointer == nullptr) fail("renderer: this OpenGL has no {}, expected version 3.3", name);
}

GlFunctions load_functions(const GlContext& context) {
  GlFunctions loaded;
#define VINEBENCH_GL_LOAD(TYPE, name) load(context, "gl" #name, loaded.name);
  VINEBENCH_GL_FUNCTIONS(VINEBENCH_GL_LOAD)
#undef VINEBENCH_GL_LOAD
  return loaded;
}

/// One platform a process: read once, so that a later change of the environment mixes nothing.
const std::string& platform() {
  static const std::string name = [] {
    const char* value = std::getenv("VINEBENCH_GL");
    return std::string(value == nullptr ? "osmesa" : value);
  }();
  return name;
}

}  // namespace

std::unique_ptr<GlContext> make_gl_context() {
  static std::once_flag loaded;
  std::unique_ptr<GlContext> context;
  if (platform() == "osmesa") {
    context = make_osmesa_context();
  } else if (platform() == "egl") {
    context = make_egl_context();
  } else {
    fail("VINEBENCH_GL={}: expected osmesa or egl", platform());
  }
  const CurrentContext current(*context);
  std::call_once(loaded, [&] { gl = load_functions(*context); });
  return context;
}

}  // namespace vinebench
