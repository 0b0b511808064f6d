// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "core/util/error.h"
#include "sim/render/gl/platform/gl_context.h"

#ifdef VINEBENCH_HAS_OSMESA

#include <GL/osmesa.h>

#include <array>
#include <cstdint>

namespace vinebench::sim {
namespace {

class OsmesaContext : public GlContext {
 public:
  OsmesaContext() {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              0,
                              OSMESA_STENCIL_BITS,
                              0,
                              OSMESA_ACCUM_BITS,
                              0,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              2,
                              0};
    const std::scoped_lock lock(gl_mutex());
    context_ = OSMesaCreateContextAttribs(attributes, nullptr);
    if (context_ == nullptr) fail("renderer: OSMesa gives no OpenGL 4.2 core context");
  }
  ~OsmesaContext() override {
    const std::scoped_lock lock(gl_mutex());
    OSMesaDestroyContext(context_);
  }

  void make_current() override {
    if (!OSMesaMakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, kSide, kSide)) {
      fail("renderer: OSMesa cannot make its context current");
    }
  }
  void release() override { OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0); }
  Function function(const char* name) const override { return OSMesaGetProcAddress(name); }

 private:
  static constexpr int kSide = 4;
  OSMesaContext context_ = nullptr;
  std::array<std::uint8_t, 4 * kSide * kSide> window_{};  // never drawn to
};

}  // namespace

bool has_osmesa() {
  return true;
}

std::unique_ptr<GlContext> make_osmesa_context() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace vinebench::sim

#else

namespace vinebench::sim {

bool has_osmesa() {
  return false;
}

std::unique_ptr<GlContext> make_osmesa_context() {
  fail("renderer: this build has no OSMesa; install libosmesa6-dev and build again");
}

}  // namespace vinebench::sim

#endif
