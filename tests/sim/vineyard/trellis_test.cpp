// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/vineyard/trellis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "sim/config_files.h"
#include "sim/rover/physics_world.h"
#include "sim/rover/rover.h"
#include "sim/textures/textures.h"
#include "sim/world/world_layout.h"

namespace vinebench::sim {
namespace {

const std::filesystem::path kModels =
    std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover";

WorldConfig one_row() {
  WorldConfig world;
  world.rows = {{{0, 0}, {6, 0}}};
  return world;
}

TEST(TrellisTest, BracesHoldTheEndPostsFromTheirSide) {
  WorldConfig world = one_row();
  world.trellis.end_brace = WorldConfig::Trellis::Brace::kAnchor;
  world.trellis.end_lean_deg = 15;
  const WorldLayout layout = lay_out(world);
  const std::vector<Brace> anchors = trellis_braces(world.trellis, layout);
  ASSERT_EQ(anchors.size(), 2u);
  EXPECT_LT(anchors[0].foot.x(), anchors[0].head.x());
  EXPECT_LT(anchors[0].head.x(), 0);
  EXPECT_GT(anchors[1].foot.x(), anchors[1].head.x());
  EXPECT_EQ(anchors[0].foot.z(), 0);
  world.trellis.end_brace = WorldConfig::Trellis::Brace::kStrut;
  const std::vector<Brace> struts = trellis_braces(world.trellis, layout);
  EXPECT_GT(struts[0].foot.x(), 0.5);
  EXPECT_LT(struts[1].foot.x(), 5.5);
  world.trellis.end_brace = WorldConfig::Trellis::Brace::kNone;
  EXPECT_TRUE(trellis_braces(world.trellis, layout).empty());
}

TEST(TrellisTest, TheDripLineHangsBetweenItsClips) {
  WorldConfig world = one_row();
  world.trellis.drip_line = 0.45;
  world.trellis.drip_sag = 0.03;
  Scene scene;
  add_trellis(scene, world.trellis, lay_out(world), 1);
  double low = 1, high = 0, length = 0;
  for (const Wire& wire : scene.wires) {
    if (wire.radius < 0.005f) continue;  // a steel wire
    EXPECT_NEAR(wire.radius, 0.008, 1e-6);
    low = std::min({low, static_cast<double>(wire.from.z()), static_cast<double>(wire.to.z())});
    high = std::max(high, static_cast<double>(wire.from.z()));
    length += std::abs(wire.to.x() - wire.from.x());
  }
  EXPECT_NEAR(high, 0.45, 1e-6);
  EXPECT_NEAR(low, 0.42, 1e-6);
  EXPECT_NEAR(length, 6, 1e-5);
}

TEST(TrellisTest, PostsAndBracesStandInTheRoversWayToo) {
  WorldConfig world = one_row();
  world.trellis.end_lean_deg = 15;
  world.trellis.end_brace = WorldConfig::Trellis::Brace::kAnchor;
  PhysicsWorld physics(kModels / "rover.xml", world);
  physics.refresh();
  const int post = physics.find(mjOBJ_GEOM, "post 0");
  // Its middle is at half its height and leans out.
  EXPECT_NEAR(physics.state().geom_xpos[3 * post], -0.8 * std::tan(15 * 3.14159265358979 / 180),
              1e-9);
  EXPECT_NO_THROW(physics.find(mjOBJ_GEOM, "brace 1"));
}

}  // namespace
}  // namespace vinebench::sim
