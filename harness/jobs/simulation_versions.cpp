// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/simulation_versions.h"

#include <mujoco/mujoco.h>

#include "core/util/pin_arithmetic.h"
#include "sim/render/gl/platform/gl_context.h"

namespace vinebench::harness {
namespace {

bool draws_by_egl(sim::GlBackend backend) {
  return backend == sim::GlBackend::kEgl ||
         (backend == sim::GlBackend::kAuto && !sim::has_osmesa());
}

}  // namespace

NamedValues simulation_versions(const std::string& platform) {
  sim::RendererConfig renderer;
  sim::choose_backend(renderer, platform);
  return {{"MuJoCo", mj_versionString()}, {"OpenGL", sim::gl_version(renderer.backend)}};
}

NamedValues drawing_libraries(const sim::RendererConfig& renderer) {
  NamedValues libraries{{"mujoco", mj_versionString()}};
  if (renderer.engine == sim::RenderEngineKind::kGl) {
    libraries.emplace_back("opengl", sim::gl_version(renderer.backend));
    libraries.emplace_back("renderer", sim::gl_renderer(renderer.backend));
    // What EGL loads later looks in the process first, and not in what the libraries look in.
    if (are_libraries_pinned() && draws_by_egl(renderer.backend)) {
      libraries.emplace_back("driver", processor_text());
    }
  }
  return libraries;
}

}  // namespace vinebench::harness
