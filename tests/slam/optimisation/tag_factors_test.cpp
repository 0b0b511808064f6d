// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/tag_factors.h"

#include <gtest/gtest.h>

#include "tests/support/aisle_map.h"
#include "tests/support/write_poses.h"

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
    test::write_poses(problem, made_.map);
    factors.write_back(made_.map);
    return cost;
  }

  /// A second tag beside the first, seen by both keyframes.
  void see_another() {
    for (int k = 0; k < 2; ++k) {
      Keyframe& keyframe = made_.map.keyframe(k);
      auto frame = std::make_shared<FrameFeatures>(*keyframe.frame);
      const auto seen = aisle_.frame_with_tag(k, poses_[static_cast<std::size_t>(k)], other_);
      frame->tags.push_back(seen->tags.back());
      frame->tags.back().id = 1;
      keyframe.frame = frame;
    }
    made_.map.tags().push_back({"tag36h11", 1, 0.161, other_});
  }
  /// Surveyed in that place of the world, which lies in the map as it is.
  static void survey(MapTag& tag, const Pose& T_world_tag, double sigma) {
    tag.fixed = false;
    tag.survey = SurveyedPlace{T_world_tag, sigma * sigma * Matrix6d::Identity()};
  }

  const std::vector<Pose> poses_{Pose{}, {exp_so3({0, 0, 0.05}), {0.1, 0.01, 0}}};
  SyntheticAisle aisle_{0, 1, 60};
  const Pose tag_ =
      aisle_.rig.cameras[4].T_body_cam * Pose{exp_so3({0.2, 0.3, 0}), {0.1, 0.02, 0.6}};
  const Pose other_ = tag_ * Pose{exp_so3({0.05, 0.1, 0}), {-0.2, 0.05, 0.05}};
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

// A tag that its first sighting placed badly bends no way; a global adjustment finds its place.
TEST_F(TagFactorsTest, ATagThatIsNotSurelyPlacedWaitsForAGlobalAdjustment) {
  mapped().fixed = false;
  mapped().sure = false;
  mapped().T_map_tag = tag_ * off_;
  pose(1) = pose(1) * off_;
  EXPECT_EQ(adjusted({{1}, {0}}, false), 0);  // there are no factors
  EXPECT_EQ(distance(pose(1), poses_[1] * off_), 0);
  EXPECT_FALSE(mapped().sure);
  EXPECT_NEAR(adjusted({{1}, {0}}, true), 0, 1e-9);
  EXPECT_LT(distance(mapped().T_map_tag, tag_), 1e-6);
  EXPECT_LT(distance(pose(1), poses_[1]), 1e-6);
  EXPECT_TRUE(mapped().sure);
}

// Both surveys are off by the same step of the world: nothing but the world's place has to change.
TEST_F(TagFactorsTest, TheWorldComesToWhereTheSurveysHaveIt) {
  see_another();
  const Pose world{exp_so3({0, 0, 0.3}), {1, 2, 0}};
  survey(mapped(), world.inverse() * tag_, 0.01);
  survey(made_.map.tags()[1], world.inverse() * other_, 0.02);
  made_.map.world() = world * off_;
  pose(1) = pose(1) * off_;
  EXPECT_NEAR(adjusted({{1}, {0}}, true), 0, 1e-9);
  EXPECT_LT(distance(*made_.map.world(), world), 1e-6);
  EXPECT_LT(angle(*made_.map.world(), world), 1e-6);
  EXPECT_LT(distance(pose(1), poses_[1]), 1e-6);
  EXPECT_LT(distance(mapped().T_map_tag, tag_), 1e-6);
}

// Surveyed 2 cm too far apart with 1 cm each: corners of 0.3 px at 0.6 m know to a millimetre where
// they are, so the tags hardly move, and the keyframe between them does not bend.
TEST_F(TagFactorsTest, SurveysThatContradictEachOtherDoNotBendTheMap) {
  see_another();
  survey(mapped(), tag_, 0.01);
  Pose apart = other_;
  apart.translation.x() += 0.02;
  survey(made_.map.tags()[1], apart, 0.01);
  made_.map.world() = Pose{};
  EXPECT_GT(adjusted({{1}, {0}}, true), 0.1);
  EXPECT_LT(distance(pose(1), poses_[1]), 1e-3);
  EXPECT_LT(distance(made_.map.tags()[1].T_map_tag, other_), 2e-3);
  // Tags of known pose would: that is what they are for.
  mapped() = {"tag36h11", 0, 0.161, tag_, true};
  made_.map.tags()[1] = {"tag36h11", 1, 0.161, apart, true};
  adjusted({{1}, {0}}, true);
  EXPECT_GT(distance(pose(1), poses_[1]), 1e-3);
}

// Beside a tag that stands exactly where it was surveyed the world's place is known.
TEST_F(TagFactorsTest, AFixedTagHoldsTheWorld) {
  see_another();
  survey(made_.map.tags()[1], other_ * off_, 0.01);
  made_.map.world() = Pose{};
  adjusted({{1}, {0}}, true);
  EXPECT_EQ(distance(*made_.map.world(), Pose{}), 0);
  EXPECT_EQ(distance(mapped().T_map_tag, tag_), 0);
}

TEST_F(TagFactorsTest, OneSurveyAloneSaysNothingOfTheMap) {
  survey(mapped(), tag_ * off_, 0.01);
  made_.map.world() = Pose{};
  EXPECT_TRUE(made_.map.is_held(mapped()));
  EXPECT_NEAR(adjusted({{1}, {0}}, true), 0, 1e-9);
  EXPECT_EQ(distance(mapped().T_map_tag, tag_), 0);
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
