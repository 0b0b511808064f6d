// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/gl/platform/gl_context.h"

#include <cstdlib>

#include "core/util/error.h"

namespace vinebench::sim {

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

std::string gl_text(GlBackend backend, GLenum name) {
  const std::unique_ptr<GlContext> context = make_gl_context(backend);
  const CurrentContext current(*context);
  PFNGLGETSTRINGPROC get_string = nullptr;
  load(*context, "glGetString", get_string);
  const GLubyte* text = get_string(name);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

}  // namespace

std::recursive_mutex& gl_mutex() {
  static std::recursive_mutex mutex;
  return mutex;
}

void draw_without_threads() {
  setenv("LP_NUM_THREADS", "0", 1);                // of the rasteriser
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // it writes its files in a thread
}

void CurrentContext::wait() {
  const GlFunctions& gl = context_.functions();
  const GLsync drawn = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.Flush();
  lock_.unlock();
  constexpr GLuint64 kSecond = 1'000'000'000;  // ns
  while (gl.ClientWaitSync(drawn, 0, kSecond) == GL_TIMEOUT_EXPIRED) {
  }
  lock_.lock();
  gl.DeleteSync(drawn);
}

const GlFunctions& GlContext::functions() {
  if (!functions_) functions_ = std::make_unique<GlFunctions>(load_functions(*this));
  return *functions_;
}

GlContext::GlContext() = default;
GlContext::~GlContext() = default;

std::unique_ptr<GlContext> make_gl_context(GlBackend backend) {
  switch (backend) {
    case GlBackend::kOsmesa:
      return make_osmesa_context();
    case GlBackend::kEgl:
      return make_egl_context();
    default:
      return has_osmesa() ? make_osmesa_context() : make_egl_context();
  }
}

std::string gl_version(GlBackend backend) {
  return gl_text(backend, GL_VERSION);
}

std::string gl_renderer(GlBackend backend) {
  std::string text = gl_text(backend, GL_RENDERER);
  const std::size_t width = text.find(" bits)");
  const std::size_t comma = text.rfind(',', width);
  if (width != std::string::npos && comma != std::string::npos) {
    text.erase(comma, width + std::string_view(" bits").size() - comma);
  }
  return text;
}

}  // namespace vinebench::sim
