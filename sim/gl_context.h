// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

namespace vinebench {

/// The seam to the platform: an off-screen GL 3.3 core context. Current in one thread at a time.
class GlContext {
 public:
  using Function = void (*)();
  virtual ~GlContext() = default;
  virtual void make_current() = 0;
  /// Leaves no context current in the calling thread, so that another may take it.
  virtual void release() = 0;
  /// The entry point of that name, null when there is none.
  virtual Function function(const char* name) const = 0;
};

/// Makes a software context through OSMesa. Throws Error when there is none to be had.
std::unique_ptr<GlContext> make_osmesa_context();

/// The same through EGL's surfaceless platform, for systems whose Mesa has no OSMesa any more.
std::unique_ptr<GlContext> make_egl_context();

/// A context of the platform that the environment variable VINEBENCH_GL names, "osmesa" (the
/// default) or "egl", with the entry points of sim/gl.h loaded.
std::unique_ptr<GlContext> make_gl_context();

/// Makes a context current for a scope.
class CurrentContext {
 public:
  explicit CurrentContext(GlContext& context) : context_(context) { context_.make_current(); }
  ~CurrentContext() { context_.release(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

 private:
  GlContext& context_;
};

}  // namespace vinebench
