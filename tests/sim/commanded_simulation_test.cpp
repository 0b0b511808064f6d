// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "sim/commanded_simulation.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "sim/config_files.h"
#include "tests/support/shared_plants.h"
#include "tests/support/test_folder.h"

namespace vinebench::sim {
namespace {

constexpr double kMount = 0.15;  // m, of the camera before the body's origin
constexpr double kWall = 3;      // m, of a box's face in the world

constexpr const char* kOneCamera = R"(
name: one
rate_hz: 15
cameras:
  - {name: front, width: 96, height: 64, fx: 60, fy: 60, position: [0.15, 0, 0.5]}
)";

/// A rover before a box, and a camera that looks at its face.
class CommandedSimulationTest : public testing::Test {
 protected:
  SimulationConfig config() const {
    const std::filesystem::path models =
        std::filesystem::path(VINEBENCH_SOURCE_DIR) / "models/csl-rover";
    SimulationConfig config;
    config.world.rows = {{{-4, 3}, {-2, 3}}};  // out of the way; a world has one
    config.world.vines.templates = 1;
    config.world.occluders = {{.size = {{1, 4, 2}}, .position = {kWall + 0.5, 0}}};
    config.rover = load_rover(models / "rover.yaml");
    config.rover.rig = folder_.write("rig.yaml", kOneCamera);
    config.route.waypoints.resize(2);
    config.route.waypoints[1].position = {1, 0};
    return config;
  }
  std::unique_ptr<CommandedSimulation> simulation(const SimulationConfig& config,
                                                  WorkerPool& pool) const {
    CapturePlan plan;
    plan.depth = true;
    return make_commanded_simulation(config, 1, test::shared_plants(), pool, plan);
  }

  test::TestFolder folder_;
};

// Depth at the image's middle is the distance of the face from the camera, which is at the true
// pose. Between two frames the rover drives 27 mm: an image of any other state would be off by
// that. 2 mm: the depth buffer's step, and a pitch of some hundredths of a degree as it
// accelerates.
TEST_F(CommandedSimulationTest, ImagesAreThoseOfTheReturnedState) {
  WorkerPool pool(1);
  const auto source = simulation(config(), pool);
  double before = 0;
  for (int i = 0; i < 12; ++i) {
    const Sample sample = source->next().value();
    const double x = sample.truth.T_world_body.translation.x();
    const float depth = sample.truth.views.at(0).image.depth.at<float>(32, 48);
    EXPECT_NEAR(depth, kWall - kMount - x, 0.002) << i;
    if (i > 4) {
      EXPECT_NEAR(x - before, 0.4 / 15, 0.004) << i;
    }
    before = x;
    source->command({0.4, 0, 0});
  }
}

TEST_F(CommandedSimulationTest, StandsUntilItIsCommanded) {
  WorkerPool pool(1);
  const auto source = simulation(config(), pool);
  for (int i = 0; i < 15; ++i) {
    const Sample sample = source->next().value();
    EXPECT_LT(sample.truth.T_world_body.translation.head<2>().norm(), 0.001);
    EXPECT_EQ(sample.frame.index, i);
  }
  EXPECT_FALSE(source->collided());
}

// 0.2 s at 15 Hz: frames 0 to 3. The route, of four seconds, ends nothing.
TEST_F(CommandedSimulationTest, EndsAtItsDurationAlone) {
  WorkerPool pool(1);
  SimulationConfig timed = config();
  timed.duration = 0.2;
  const auto ends = simulation(timed, pool);
  EXPECT_EQ(ends->size(), 4);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(ends->next().has_value());
  EXPECT_FALSE(ends->next().has_value());
  EXPECT_GT(simulation(config(), pool)->size(), 1'000'000);
}

TEST_F(CommandedSimulationTest, TheSameCommandsGiveTheSameBytesWithAnyThreads) {
  WorkerPool one(1), two(2);
  const auto a = simulation(config(), one), b = simulation(config(), two);
  for (int i = 0; i < 5; ++i) {
    const Sample left = a->next().value(), right = b->next().value();
    EXPECT_EQ(left.truth.T_world_body.translation, right.truth.T_world_body.translation);
    EXPECT_EQ(cv::norm(left.frame.images[0], right.frame.images[0], cv::NORM_INF), 0);
    for (CommandedSimulation* source : {a.get(), b.get()}) source->command({0.2, 0.1, 0.3});
  }
}

}  // namespace
}  // namespace vinebench::sim
