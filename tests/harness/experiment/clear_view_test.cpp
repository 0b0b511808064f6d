// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/experiment/clear_view.h"

#include <gtest/gtest.h>

#include "harness/experiment/scenario.h"
#include "sim/world/world_layout.h"

namespace vinebench::harness {
namespace {

// quick-loop's tag stands beside its start, in view of the side camera; 20 m away it is too small,
// and turned round the rover looks away.
TEST(ClearViewTest, ATagIsSeenFromBeside) {
  const ScenarioConfig scenario =
      load_scenario(std::string(VINEBENCH_SOURCE_DIR) + "/scenarios/quick-loop.yaml");
  const Rig rig = load_rig(scenario.simulation.rover.rig);
  const std::vector<WorldTag> tags = sim::world_tags(scenario.simulation.world);
  const ClearView view(rig);
  const auto& start = scenario.simulation.route.waypoints.front();
  const sim::Terrain terrain = sim::lay_out(scenario.simulation.world).terrain;
  const double heading = start.heading_deg * 3.14159265358979 / 180;
  const Pose there = standing_at({start.position.x(), start.position.y(), heading}, terrain);
  EXPECT_EQ(view.of(tags, there).size(), 1u);
  Pose turned = there;
  turned.rotation = turned.rotation * exp_so3({0, 0, 3.14159265358979});
  EXPECT_TRUE(view.of(tags, turned).empty());
  Pose far = there;
  far.translation += there.rotation * Eigen::Vector3d(0, 20, 0);
  EXPECT_TRUE(view.of(tags, far).empty());
}

}  // namespace
}  // namespace vinebench::harness
