// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/render/factory/make_render_engine.h"

#include <gtest/gtest.h>

#include "sim/render/fake/fake_renderer.h"
#include "sim/render/gl/gl_renderer.h"
#include "sim/render/mujoco/mujoco_renderer.h"
#include "sim/render/supersampled_engine.h"
#include "tests/support/test_folder.h"
#include "tests/support/test_scene.h"

namespace vinebench::sim {
namespace {

/// An engine for a panel in even light.
std::unique_ptr<RenderEngine> engine_of(RenderEngineKind kind, int supersampling = 1) {
  Scene scene;
  const int material = test::add_material(scene, Label::kBox, Eigen::Vector3f::Ones());
  test::add_instance(scene, test::add_model(scene, test::panel(material, 1, 1)), {0, 0, 0});
  test::light_evenly(scene);
  RendererConfig config;
  config.engine = kind;
  config.shadow_map_size = 0;
  config.supersampling = supersampling;
  return make_render_engine(scene, config);
}

TEST(MakeRenderEngineTest, MakesTheEngineThatIsNamed) {
  const auto gl = engine_of(RenderEngineKind::kGl);
  EXPECT_NE(dynamic_cast<GlRenderer*>(gl.get()), nullptr);
  const auto mujoco = engine_of(RenderEngineKind::kMujoco);
  EXPECT_NE(dynamic_cast<MujocoRenderer*>(mujoco.get()), nullptr);
  const auto fake = engine_of(RenderEngineKind::kFake);
  EXPECT_NE(dynamic_cast<FakeRenderer*>(fake.get()), nullptr);
  const auto fine = engine_of(RenderEngineKind::kFake, 2);
  EXPECT_NE(dynamic_cast<SupersampledEngine*>(fine.get()), nullptr);
}

TEST(MakeRenderEngineTest, AnEngineWithoutAnEntryIsAnError) {
  EXPECT_NE(test::error_of([] { engine_of(static_cast<RenderEngineKind>(17)); }), "");
}

}  // namespace
}  // namespace vinebench::sim
