// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/error.h"
#include "sim/render/gl/platform/gl_context.h"

#ifdef VINEBENCH_HAS_EGL

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

namespace vinebench::sim {
namespace {

/// Opened once per process; EGL is reference-counted and thread-safe.
EGLDisplay open_display() {
  const EGLDisplay display =
      eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    fail("renderer: EGL has no surfaceless platform (error {:#x})", eglGetError());
  }
  return display;
}

class EglContext : public GlContext {
 public:
  EglContext() {
    const std::scoped_lock lock(gl_mutex());
    static const EGLDisplay display = open_display();
    display_ = display;
    const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                       EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglChooseConfig(display_, wanted.data(), &config, 1, &count);
    const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           4,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           2,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
    eglBindAPI(EGL_OPENGL_API);
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) {
      fail("renderer: EGL gives no OpenGL 4.2 core context (error {:#x})", eglGetError());
    }
  }
  ~EglContext() override {
    const std::scoped_lock lock(gl_mutex());
    eglDestroyContext(display_, context_);
  }

  void make_current() override {
    eglBindAPI(EGL_OPENGL_API);
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      fail("renderer: EGL cannot make its context current (error {:#x})", eglGetError());
    }
  }
  void release() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  Function function(const char* name) const override { return eglGetProcAddress(name); }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

bool has_egl() {
  return true;
}

std::unique_ptr<GlContext> make_egl_context() {
  return std::make_unique<EglContext>();
}

}  // namespace vinebench::sim

#else

namespace vinebench::sim {

bool has_egl() {
  return false;
}

std::unique_ptr<GlContext> make_egl_context() {
  fail("renderer: this build has no EGL; install libegl-dev and build again");
}

}  // namespace vinebench::sim

#endif
