// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/tag_factors.h"

#include <gtest/gtest.h>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::angle;
using test::distance;
using test::SyntheticAisle;

/// Two keyframes whose side camera sees a tag 0.6 m ahead of it.
class TagFactorsTest : public testing::Test {
 protected:
  TagFactorsTest() {
    for (std::size_t k = 0; k < 2; ++k) {
      made_.add(aisle_.frame_with_tag(static_cast<std::int64_t>(k), poses_[k], tag_), poses_[k]);
    }
    made_.map.tags().push_back({"tag36h11", 0, 0.161, tag_, true});
  }
  MapTag& mapped() { return made_.map.tags()[0]; }
  Pose& pose(int keyframe) { return made_.map.keyframe(keyframe).T_map_body; }

  /// Cost reached by the corners alone.
  double adjusted(const AdjustmentWindow& window, bool tags_move) {
    ProblemBuilder problem(made_.map, window);
    TagFactors factors(made_.rig.tag_cameras, 0.3, tags_move);
    factors.add_to(problem, made_.map);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-16;
    options.logging_type = ceres::SILENT;
    const double cost = problem.solve(options);
    problem.write_poses(made_.map);
    factors.write_back(made_.map);
    return cost;
  }

  const std::vector<Pose> poses_{Pose{}, {exp_so3({0, 0, 0.05}), {0.1, 0.01, 0}}};
  SyntheticAisle aisle_{0, 1, 60};
  const Pose tag_ =
      aisle_.rig.cameras[4].T_body_cam * Pose{exp_so3({0.2, 0.3, 0}), {0.1, 0.02, 0.6}};
  const Pose off_{exp_so3({0.01, -0.02, 0.01}), {0.01, 0.01, -0.005}};
  AisleMap made_{aisle_, {}};
};

// Corners are doubles: four of them put a pose right to the solver's tolerance.
TEST_F(TagFactorsTest, AMovedKeyframeComesToWhereItsTagPutsIt) {
  pose(1) = pose(1) * off_;
  EXPECT_NEAR(adjusted({{1}, {0}}, false), 0, 1e-9);
  EXPECT_LT(distance(pose(1), poses_[1]), 1e-6);
  EXPECT_LT(angle(pose(1), poses_[1]), 1e-6);
  EXPECT_EQ(distance(mapped().T_map_tag, tag_), 0);
}

TEST_F(TagFactorsTest, AMappedTagComesToWhereTheKeyframesSeeIt) {
  mapped().fixed = false;
  mapped().T_map_tag = tag_ * off_;
  EXPECT_NEAR(adjusted({{1}, {0}}, true), 0, 1e-9);
  EXPECT_LT(distance(mapped().T_map_tag, tag_), 1e-6);
  EXPECT_LT(distance(pose(1), poses_[1]), 1e-6);  // held by the fixed one's sighting
}

TEST_F(TagFactorsTest, ATagIsHeldWhereItsPoseIsKnownOrTagsDoNotMove) {
  for (const auto& [fixed, tags_move] : {std::pair(true, true), {false, false}}) {
    mapped().fixed = fixed;
    mapped().T_map_tag = tag_ * off_;
    EXPECT_GT(adjusted({{}, {0, 1}}, tags_move), 1);
    EXPECT_EQ(distance(mapped().T_map_tag, tag_ * off_), 0);
  }
}

TEST_F(TagFactorsTest, ASightingOfAnUnknownTagHasNoFactor) {
  mapped().id = 9;
  mapped().fixed = false;
  mapped().T_map_tag = tag_ * off_;
  pose(1) = pose(1) * off_;
  adjusted({{1}, {0}}, true);
  EXPECT_LT(distance(pose(1), poses_[1] * off_), 1e-12);
  EXPECT_EQ(distance(mapped().T_map_tag, tag_ * off_), 0);
}

TEST_F(TagFactorsTest, TheSizeIsTheMaps) {
  // A tag mapped twice as large must be twice as far from the camera.
  mapped().fixed = false;
  mapped().size *= 2;
  EXPECT_NEAR(adjusted({{}, {0}}, true), 0, 1e-9);
  const Pose T_world_cam = aisle_.rig.cameras[4].T_body_cam;
  EXPECT_NEAR((T_world_cam.inverse() * mapped().T_map_tag).translation.norm(),
              2 * (T_world_cam.inverse() * tag_).translation.norm(), 1e-4);
}

}  // namespace
}  // namespace vinebench::slam
