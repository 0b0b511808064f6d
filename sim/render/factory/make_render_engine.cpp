// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/factory/make_render_engine.h"

#include <utility>

#include "core/util/error.h"
#include "sim/render/fake/fake_renderer.h"
#include "sim/render/gl/gl_renderer.h"
#include "sim/render/mujoco/mujoco_renderer.h"
#include "sim/render/supersampled_engine.h"

namespace vinebench::sim {
namespace {

std::unique_ptr<RenderEngine> make_plain(const Scene& scene, const RendererConfig& config) {
  switch (config.engine) {
    case RenderEngineKind::kGl:
      return std::make_unique<GlRenderer>(scene, config);
    case RenderEngineKind::kMujoco:
      return std::make_unique<MujocoRenderer>(scene, MujocoRendererConfig{});
    case RenderEngineKind::kFake:
      return std::make_unique<FakeRenderer>(scene);
  }
  fail("renderer: no engine has the number {}", static_cast<int>(config.engine));
}

}  // namespace

std::unique_ptr<RenderEngine> make_render_engine(const Scene& scene, const RendererConfig& config) {
  std::unique_ptr<RenderEngine> engine = make_plain(scene, config);
  if (config.supersampling == 1) return engine;
  return std::make_unique<SupersampledEngine>(std::move(engine), config.supersampling);
}

}  // namespace vinebench::sim
