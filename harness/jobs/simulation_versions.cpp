// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/jobs/simulation_versions.h"

#include <mujoco/mujoco.h>

#include "sim/render/gl/platform/gl_context.h"
#include "sim/render/renderer_config.h"

namespace vinebench::harness {

std::vector<std::pair<std::string, std::string>> simulation_versions(const std::string& platform) {
  sim::RendererConfig renderer;
  sim::choose_backend(renderer, platform);
  return {{"MuJoCo", mj_versionString()}, {"OpenGL", sim::gl_version(renderer.backend)}};
}

}  // namespace vinebench::harness
