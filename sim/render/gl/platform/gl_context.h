// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "sim/render/gl/platform/gl.h"
#include "sim/render/gl/platform/gl_backend.h"

namespace vinebench::sim {

/// Held by whoever calls OpenGL. Contexts of Mesa's software renderer share one screen, and before
/// an upload or a new texture Mesa 22.3 looks through the unfinished scenes of all contexts without
/// a lock (lp_setup_is_resource_referenced), while other threads change them. What is drawn is
/// rasterised by threads of Mesa's own, which do not need this.
std::recursive_mutex& gl_mutex();

/// The seam to the platform: an off-screen GL 4.2 core context. Current in one thread at a time;
/// its functions are called with gl_mutex() held.
class GlContext {
 public:
  using Function = void (*)();
  GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  virtual ~GlContext();
  virtual void make_current() = 0;
  /// Leaves no context current in the calling thread, so that another may take it.
  virtual void release() = 0;
  /// The entry point of that name, null when there is none.
  virtual Function function(const char* name) const = 0;
  /// All that sim/render/gl/platform/gl.h names, loaded at the first call, when the context must be
  /// current; valid as long as the context. Throws Error that names what this OpenGL has not.
  const GlFunctions& functions();

 private:
  std::unique_ptr<GlFunctions> functions_;
};

/// Whether this build has that platform.
bool has_osmesa();
bool has_egl();

/// From now on OSMesa's software renderer draws in the thread that calls it, and has no other: for
/// processes that are forked. Call it before the first context; changes no pixel.
void draw_without_threads();

/// A software context through OSMesa. Throws Error when there is none to be had.
std::unique_ptr<GlContext> make_osmesa_context();

/// A context through EGL without any surface: Mesa's software renderer, or the driver of a GPU.
/// Throws Error when there is none to be had.
std::unique_ptr<GlContext> make_egl_context();

/// The one place that chooses a platform. Throws Error when that one was not built or does not
/// work.
std::unique_ptr<GlContext> make_gl_context(GlBackend backend = GlBackend::kAuto);

/// What OpenGL says of itself: "4.5 (Core Profile) Mesa 22.3.6".
std::string gl_version(GlBackend backend = GlBackend::kAuto);

/// What draws: "llvmpipe (LLVM 15.0.6)", without the width of its vectors, which changes no pixel.
std::string gl_renderer(GlBackend backend = GlBackend::kAuto);

/// Makes a context current for a scope, in which no other thread is in OpenGL.
class CurrentContext {
 public:
  explicit CurrentContext(GlContext& context) : lock_(gl_mutex()), context_(context) {
    context_.make_current();
  }
  ~CurrentContext() { context_.release(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;
  const GlFunctions& gl() const { return context_.functions(); }
  /// Waits until all is drawn, and lets other threads into OpenGL meanwhile.
  void wait();

 private:
  std::unique_lock<std::recursive_mutex> lock_;
  GlContext& context_;
};

}  // namespace vinebench::sim
