// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

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

/// A context with the entry points of sim/gl.h loaded. The one place that chooses a platform.
std::unique_ptr<GlContext> make_gl_context();

/// What OpenGL says of itself: "4.5 (Core Profile) Mesa 22.3.6".
std::string gl_version();

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
