// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/gl_context.h"

#include <mutex>

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

}  // namespace

std::unique_ptr<GlContext> make_gl_context() {
  static std::once_flag loaded;
  std::unique_ptr<GlContext> context = make_osmesa_context();
  const CurrentContext current(*context);
  std::call_once(loaded, [&] { gl = load_functions(*context); });
  return context;
}

std::string gl_version() {
  const std::unique_ptr<GlContext> context = make_osmesa_context();
  const CurrentContext current(*context);
  PFNGLGETSTRINGPROC get_string = nullptr;
  load(*context, "glGetString", get_string);
  const GLubyte* text = get_string(GL_VERSION);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

}  // namespace vinebench
