// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/platform/gl_context.h"

#include <cstdlib>
#include <map>
#include <string_view>

#include "core/util/error.h"
#include "sim/render/gl/platform/gl.h"

namespace vinebench::sim {

thread_local GlFunctions gl;

namespace {

template <class Pointer>
void load(const GlContext& context, const char* name, Pointer& pointer) {
  pointer = reinterpret_cast<Pointer>(context.function(name));
  if (pointer == nullptr) fail("renderer: this OpenGL has no {}, expected version 4.2", name);
}

GlFunctions load_functions(const GlContext& context) {
  GlFunctions loaded;
#define VINEBENCH_GL_LOAD(TYPE, name) load(context, "gl" #name, loaded.name);
  VINEBENCH_GL_FUNCTIONS(VINEBENCH_GL_LOAD)
#undef VINEBENCH_GL_LOAD
  return loaded;
}

GlBackend chosen(GlBackend backend) {
  const char* wanted = std::getenv("VINEBENCH_GL");
  if (backend != GlBackend::kAuto || wanted == nullptr || *wanted == '\0') return backend;
  if (std::string_view(wanted) == "osmesa") return GlBackend::kOsmesa;
  if (std::string_view(wanted) == "egl") return GlBackend::kEgl;
  fail("VINEBENCH_GL={}: expected osmesa or egl", wanted);
}

}  // namespace

CurrentContext::CurrentContext(GlContext& context) : context_(context) {
  context_.make_current();
  gl = context_.functions();
}

const GlFunctions& GlContext::functions() {
  if (!functions_) functions_ = std::make_unique<GlFunctions>(load_functions(*this));
  return *functions_;
}

GlContext::GlContext() = default;
GlContext::~GlContext() = default;

std::unique_ptr<GlContext> make_gl_context(GlBackend backend) {
  switch (chosen(backend)) {
    case GlBackend::kOsmesa:
      return make_osmesa_context();
    case GlBackend::kEgl:
      return make_egl_context();
    default:
      return has_osmesa() ? make_osmesa_context() : make_egl_context();
  }
}

std::string gl_version() {
  const std::unique_ptr<GlContext> context = make_gl_context();
  const CurrentContext current(*context);
  PFNGLGETSTRINGPROC get_string = nullptr;
  load(*context, "glGetString", get_string);
  const GLubyte* text = get_string(GL_VERSION);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

}  // namespace vinebench::sim
