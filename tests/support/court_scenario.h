// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#include "harness/experiment/scenario.h"
#include "harness/machine.h"
#include "tests/support/mesh_world.h"

namespace vinebench::test {

/// Six frames in the world of write_mesh_world(), of which the fake renderer shows a court: runs
/// need neither OpenGL nor plants.
class CourtScenario : public testing::Test {
 protected:
  static constexpr std::int64_t kFrames = 6;  // of 0.34 s at 15 Hz

  CourtScenario() {
    write_mesh_world(folder_);
    folder_.write("rig.yaml", R"(name: pair
rate_hz: 15
cameras:
  - {name: left, width: 160, height: 96, fx: 80, fy: 80, position: [0.15, 0.06, 0.5]}
  - {name: right, width: 160, height: 96, fx: 80, fy: 80, position: [0.15, -0.06, 0.5]}
stereo_pairs:
  - {name: front, left: left, right: right}
)");
    const std::string models = std::string(VINEBENCH_SOURCE_DIR) + "/models/csl-rover";
    file_ = folder_.write("court.yaml", R"(name: court
seed: 5
world: world.yaml
rover: {model: )" + models + R"(/rover.xml, rig: rig.yaml}
route:
  acceleration: 2
  waypoints: [{position: [0, 0]}, {position: [1, 0]}]
renderer: {engine: fake}
duration: 0.34
)");
  }
  /// Large enough to be tracked in the court.
  void write_large_rig() {
    folder_.write("rig.yaml", R"(name: pair
rate_hz: 15
cameras:
  - {name: left, width: 376, height: 240, fx: 130, fy: 130, position: [0.15, 0.06, 0.5]}
  - {name: right, width: 376, height: 240, fx: 130, fy: 130, position: [0.15, -0.06, 0.5]}
stereo_pairs:
  - {name: front, left: left, right: right}
)");
  }

  harness::ScenarioConfig scenario() const { return harness::load_scenario(file_); }
  harness::Machine machine() const { return {"", folder_ / "cache"}; }

  TestFolder folder_;
  std::filesystem::path file_;
};

}  // namespace vinebench::test
