// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/drawn_scene.h"

#include <gtest/gtest.h>

#include "sim/config_files.h"
#include "sim/sim.h"
#include "tests/support/shared_plants.h"

namespace vinebench::sim {
namespace {

SimulationConfig config() {
  SimulationConfig config;
  config.world.rows = {{{0, 1.5}, {2, 1.5}}};
  config.rover =
      load_rover(std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover/rover.yaml");
  config.renderer.engine = RenderEngineKind::kFake;
  return config;
}

TEST(DrawnSceneTest, ServesWhatIsDrawnTheSame) {
  const DrawnScene drawn(config(), 1, test::shared_plants(), 1);
  EXPECT_TRUE(drawn.serves(config(), 1));
  SimulationConfig noisy = config();
  noisy.sensors.camera.noise.read_noise = 100;
  noisy.duration = 3;
  EXPECT_TRUE(drawn.serves(noisy, 1));
  EXPECT_FALSE(drawn.serves(config(), 2));
  SimulationConfig windy = config();
  windy.world.wind.speed = 1;
  EXPECT_FALSE(drawn.serves(windy, 1));
  SimulationConfig without_shadows = config();
  without_shadows.renderer.shadow_map_size = 0;
  EXPECT_FALSE(drawn.serves(without_shadows, 1));
}

TEST(DrawnSceneTest, WhatDrawsWithoutOpenGlMayBeForked) {
  EXPECT_TRUE(draws_in_calling_thread({.engine = RenderEngineKind::kFake}));
  EXPECT_FALSE(draws_in_calling_thread({.engine = RenderEngineKind::kMujoco}));
  EXPECT_FALSE(draws_in_calling_thread({.backend = GlBackend::kEgl}));
}

}  // namespace
}  // namespace vinebench::sim
