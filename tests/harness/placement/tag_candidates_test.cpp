// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "harness/placement/tag_candidates.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>

namespace vinebench::harness {
namespace {

const std::string kSource = VINEBENCH_SOURCE_DIR;

/// Two rows along x, 2.5 m apart, with posts at 0, 5 and 10 m, and a drive between them, whose side
/// camera looks to the right, at row 0.
class TagCandidatesTest : public testing::Test {
 protected:
  TagCandidatesTest() {
    sim::WorldConfig& world = scenario_.simulation.world;
    world.tags.clear();
    world.occluders.clear();
    world.block.reset();
    world.rows = {{{0, -1.25}, {10, -1.25}}, {{0, 1.25}, {10, 1.25}}};
    world.trellis.post_spacing = 5;
    world.terrain = {};
    auto& waypoints = scenario_.simulation.route.waypoints;
    waypoints.clear();
    for (const double x : {1.0, 9.0}) {
      waypoints.emplace_back();
      waypoints.back().position = {x, 0};
    }
  }

  ScenarioConfig scenario_ = load_scenario(kSource + "/scenarios/aisle-loop.yaml");
  Rig rig_ = load_rig(scenario_.simulation.rover.rig);
};

TEST_F(TagCandidatesTest, PosesAreASpacingApart) {
  const std::vector<Pose> poses = route_poses(scenario_, 0.5);
  ASSERT_NEAR(static_cast<double>(poses.size()), 17, 1);  // 8 m, and the start
  for (std::size_t k = 1; k < poses.size(); ++k) {
    const double step = (poses[k].translation - poses[k - 1].translation).norm();
    EXPECT_NEAR(step, 0.5, 0.05) << k;  // of a route that is looked at 20 times a second
  }
}

// Six posts with two sides each. From between the rows the camera sees the inner side of row 0's
// post in the middle of the drive; the outer side is turned away, row 1 is behind the camera.
TEST_F(TagCandidatesTest, AreSeenFromTheirSide) {
  auto candidates = post_candidates(scenario_.simulation.world, 0.5, 0.161);
  ASSERT_EQ(candidates.size(), 12u);
  const std::vector<Pose> poses = route_poses(scenario_, 0.25);
  predict_sightings(candidates, poses, rig_, scenario_.simulation.world, {});
  for (const TagCandidate& candidate : candidates) {
    const auto& post = candidate.tag.post.value();
    const bool inner = post.row == 0 && post.side == sim::WorldConfig::PostSide::Side::kLeft;
    if (!inner || post.index == 1) {
      EXPECT_EQ(candidate.information.empty(), !inner) << post.row << " " << post.index;
    }
  }
}

// From the pose beside the post a tag of 0.161 m is 1.2 m away: corners of 0.2 px at some 1,000 px
// focal length say where the body is across the line of sight to a millimetre.
TEST_F(TagCandidatesTest, WhatTheySayIsThatOfTheirCorners) {
  auto candidates = post_candidates(scenario_.simulation.world, 0.5, 0.161);
  const std::vector<Pose> poses = route_poses(scenario_, 0.25);
  predict_sightings(candidates, poses, rig_, scenario_.simulation.world, {});
  SightingModel rough;
  rough.survey = {0.01, 0};
  auto surveyed = post_candidates(scenario_.simulation.world, 0.5, 0.161);
  predict_sightings(surveyed, poses, rig_, scenario_.simulation.world, rough);
  const auto seen = std::ranges::find_if(
      candidates, [](const TagCandidate& tag) { return !tag.information.empty(); });
  ASSERT_NE(seen, candidates.end());
  const auto& other = surveyed[static_cast<std::size_t>(seen - candidates.begin())];
  ASSERT_EQ(other.information.size(), seen->information.size());
  const Matrix6d exact = seen->information[0].second.inverse();
  const Matrix6d with_survey = other.information[0].second.inverse();
  EXPECT_LT((exact.topLeftCorner<3, 3>().trace()), 3 * 0.02 * 0.02);
  // The survey's centimetre on each axis is part of where the body is.
  EXPECT_NEAR(((with_survey - exact).topLeftCorner<3, 3>().trace()), 3e-4, 1e-8);
}

// A third row between the drive and row 0 hides it.
TEST_F(TagCandidatesTest, RowsHideWhatIsBehindThem) {
  sim::WorldConfig& world = scenario_.simulation.world;
  world.rows.push_back({{0, -0.9}, {10, -0.9}});
  auto candidates = post_candidates(world, 0.5, 0.161);
  predict_sightings(candidates, route_poses(scenario_, 0.25), rig_, world, {});
  for (const TagCandidate& candidate : candidates) {
    if (candidate.tag.post->row == 0) {
      EXPECT_TRUE(candidate.information.empty());
    }
  }
}

TEST_F(TagCandidatesTest, TheWorldsOwnTagsHaveTheirPlaces) {
  sim::WorldConfig& world = scenario_.simulation.world;
  world.tags.push_back({});
  world.tags.back().id = 3;
  world.tags.back().position = {5, -1.2, 0.5};
  const auto tags = own_tags(world);
  ASSERT_EQ(tags.size(), 1u);
  EXPECT_EQ(tags[0].placed.id, 3);
  EXPECT_NEAR(tags[0].placed.T_world_tag.translation.y(), -1.2, 1e-9);
}

}  // namespace
}  // namespace vinebench::harness
