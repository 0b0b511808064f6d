// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/landmark_factors.h"

#include <gtest/gtest.h>

#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::SyntheticAisle;

std::vector<Pose> four_poses() {
  std::vector<Pose> poses;
  for (int k = 0; k < 4; ++k) {
    poses.push_back({exp_so3({0, 0, 0.02 * k}), {0.15 * k, 0.01 * k, 0}});
  }
  return poses;
}

ceres::Solver::Options dense() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  return options;
}

class LandmarkFactorsTest : public testing::Test {
 protected:
  double error(int point, int landmark) const {
    return (made_.map.landmark(landmark).position - aisle_.point(point)).norm();
  }
  static bool sees(const Landmark& landmark, int keyframe) {
    return std::ranges::any_of(landmark.observations,
                               [&](const Observation& o) { return o.keyframe == keyframe; });
  }
  const SyntheticAisle aisle_{0, 1, 500};
  AisleMap made_{aisle_, four_poses()};
};

TEST_F(LandmarkFactorsTest, LandmarksOfMovedKeyframesComeBackTheOthersStay) {
  const Eigen::Vector3d off(0.01, -0.005, 0.01);
  for (Landmark& landmark : made_.map.landmarks()) landmark.position += off;
  ProblemBuilder problem(made_.map, {{3}, {1, 2}});
  problem.hold(problem.pose_of(3));
  LandmarkFactors factors(made_.rig);
  factors.add_to(problem, made_.map);
  EXPECT_LT(problem.solve(dense()), 1e-4);
  factors.conclude(problem.poses(made_.map), made_.map);
  factors.write_back(made_.map);
  int adjusted = 0, left = 0;
  for (const auto& [point, landmark] : made_.landmark_of) {
    const bool takes_part = sees(made_.map.landmark(landmark), 3);
    ++(takes_part ? adjusted : left);
    if (takes_part) {
      // Pixels are floats, good to 3e-5 px: of a disparity of 32 px a metre away 1e-6 m, and with
      // the square of the distance less so; the farthest are at 4.8 m.
      EXPECT_LT(error(point, landmark), 5e-5);
    } else {
      EXPECT_NEAR(error(point, landmark), off.norm(), 1e-12);
    }
  }
  EXPECT_GT(adjusted, 50);
  EXPECT_GT(left, 0);
}

/// Keyframes whose back pair is 30 ms late, as its stamps say. What the velocity is thought to be
/// is off by 20 mm/s and 80 mrad/s, with either sign.
class LateLandmarkFactorsTest : public LandmarkFactorsTest {
 protected:
  static constexpr double kLate = 0.03;  // s

  LateLandmarkFactorsTest() {
    late_.velocity << 0.4, 0.05, 0, 0, 0, 0.5;
    late_.calibration[1].time = kLate;
    for (double& scale : seen_.rig.noise.level_scales) scale *= 0.1;
    for (int k = 0; k < 4; ++k) seen_.add(frame(k), poses_[static_cast<std::size_t>(k)]);
  }
  std::shared_ptr<FrameFeatures> frame(int k) const {
    const auto frame = late_.frame(k, poses_[static_cast<std::size_t>(k)]);
    frame->views[1].late = kLate;
    const double sign = k % 2 == 0 ? 1 : -1;
    frame->velocity += sign * (Vector6d() << 0.02, 0, 0, 0, 0, 0.08).finished();
    return frame;
  }
  /// How far the moved keyframes are from where they were, m and rad.
  double adjusted_by() {
    ProblemBuilder problem(seen_.map, {{1, 2, 3}, {0}});
    LandmarkFactors factors(seen_.rig);
    factors.add_to(problem, seen_.map);
    problem.solve(dense());
    const std::vector<Pose> found = problem.poses(seen_.map);
    double most = 0;
    for (std::size_t k = 1; k < 4; ++k) {
      most =
          std::max({most, test::distance(found[k], poses_[k]), test::angle(found[k], poses_[k])});
    }
    return most;
  }

  const std::vector<Pose> poses_ = four_poses();
  SyntheticAisle late_{0, 1, 1200};
  AisleMap seen_{late_, {}};
};

// Held to its velocity a back pair is 2.4 mrad and 0.6 mm from where it was: poses halfway between
// the pairs are off by more than 1 mrad. What is believed of velocities beforehand, 50 mrad/s, is
// not far from their 80: it leaves less than a quarter of that.
TEST_F(LateLandmarkFactorsTest, VelocitiesBetweenImagesAreFoundWithThePoses) {
  EXPECT_LT(adjusted_by(), 2.5e-4);
}

// The same images if nobody knew that they are late.
TEST_F(LateLandmarkFactorsTest, OfImagesThatAreNotLateNothingIsAsked) {
  for (int k = 0; k < 4; ++k) {
    const auto punctual = frame(k);
    punctual->views[1].late = 0;
    seen_.map.keyframe(k).frame = punctual;
  }
  EXPECT_GT(adjusted_by(), 1e-3);
}

TEST_F(LandmarkFactorsTest, KeyframesOutsideOfTheWindowHaveNoSay) {
  // Keyframe 0 saw everything 25 px off, but takes no part.
  auto spoilt = std::make_shared<FrameFeatures>(*made_.map.keyframe(0).frame);
  for (StereoView& view : spoilt->views) {
    for (Keypoint& k : view.features.keypoints) k.y += 25;
  }
  made_.map.keyframe(0).frame = spoilt;
  const auto cost = [&](const AdjustmentWindow& window) {
    ProblemBuilder problem(made_.map, window);
    LandmarkFactors factors(made_.rig);
    factors.add_to(problem, made_.map);
    return problem.solve(dense());
  };
  EXPECT_LT(cost({{3}, {1, 2}}), 1e-4);
  EXPECT_GT(cost({{3}, {0, 1, 2}}), 1);
}

TEST_F(LandmarkFactorsTest, ObservationsThatContradictTheMapAreRemoved) {
  auto spoilt = std::make_shared<FrameFeatures>(*made_.map.keyframe(2).frame);
  std::size_t wrong = 0;
  for (std::size_t f = 3; f < spoilt->views[0].features.size(); f += 10) {
    spoilt->views[0].features.keypoints[f].y += 25;
    ++wrong;
  }
  made_.map.keyframe(2).frame = spoilt;
  const auto observations = [&] {
    std::size_t count = 0;
    for (const Landmark& landmark : made_.map.landmarks()) count += landmark.observations.size();
    return count;
  };
  const std::size_t before = observations();
  ProblemBuilder problem(made_.map, {{2}, {0, 1, 3}});
  LandmarkFactors factors(made_.rig);
  factors.add_to(problem, made_.map);
  factors.conclude(problem.poses(made_.map), made_.map);  // as they are: nothing is solved
  EXPECT_EQ(before, observations());
  factors.write_back(made_.map);
  EXPECT_EQ(before - observations(), wrong);
  for (std::size_t f = 3; f < spoilt->views[0].features.size(); f += 10) {
    EXPECT_EQ(made_.map.keyframe(2).landmarks[0][f], -1);
  }
}

// With the noise of 0.3 px and one feature in thirty 8 px off: both ways reach the same minimum of
// the same cost. It is flat: where it is exact to 1e-12 of some thousand, unknowns are to 1e-4 of
// their deviations, of which the farthest points' are a decimetre.
TEST_F(LandmarkFactorsTest, OfManyKeyframesTheyHaveTheSameMinimum) {
  const SyntheticAisle noisy(0.3, 1, 500);
  AisleMap made(noisy, four_poses());
  auto spoilt = std::make_shared<FrameFeatures>(*made.map.keyframe(2).frame);
  for (std::size_t f = 3; f < spoilt->views[0].features.size(); f += 30) {
    spoilt->views[0].features.keypoints[f].y += 8;
  }
  made.map.keyframe(2).frame = spoilt;
  const AdjustmentWindow window{{1, 2, 3}, {0}};
  const auto solved = [&](bool many) {
    Map map = made.map;
    ProblemBuilder problem(map, window, many);
    LandmarkFactors factors(made.rig);
    factors.add_to(problem, map);
    const SchurOptions thorough{.iterations = 300, .tolerance = 1e-13, .linear_tolerance = 1e-8};
    const double cost = many ? problem.solve(thorough, false) : problem.solve(dense());
    const std::vector<Pose> poses = problem.poses(map);
    factors.conclude(poses, map);
    for (const int id : window.moved) {
      map.keyframe(id).T_map_body = poses[static_cast<std::size_t>(id)];
    }
    factors.write_back(map);
    return std::pair{std::move(map), cost};
  };
  const auto [few, cost_of_few] = solved(false);
  const auto [many, cost_of_many] = solved(true);
  EXPECT_NEAR(cost_of_many, cost_of_few, 1e-9 * cost_of_few);
  for (const int id : window.moved) {
    EXPECT_LT(test::distance(many.keyframe(id).T_map_body, few.keyframe(id).T_map_body), 1e-6);
    EXPECT_GT(test::distance(many.keyframe(id).T_map_body, made.map.keyframe(id).T_map_body), 1e-5);
  }
  for (const Landmark& landmark : few.landmarks()) {
    const Landmark& other = many.landmark(landmark.id);
    EXPECT_LT((other.position - landmark.position).norm(), 1e-4) << landmark.id;
    EXPECT_EQ(other.observations, landmark.observations) << landmark.id;
  }
}

TEST_F(LandmarkFactorsTest, LandmarksThatTooFewKeyframesSeeAreLeftOut) {
  const auto seen_by_three = std::ranges::count_if(
      made_.map.landmarks(), [](const Landmark& l) { return count_keyframes(l) >= 3; });
  ASSERT_LT(seen_by_three, std::ssize(made_.map.landmarks()));
  for (Landmark& landmark : made_.map.landmarks()) landmark.position.z() += 0.01;
  ProblemBuilder problem(made_.map, {{1, 2, 3}, {0}});
  LandmarkFactors factors(made_.rig, 3);
  factors.add_to(problem, made_.map);
  problem.solve(dense());
  factors.conclude(problem.poses(made_.map), made_.map);
  factors.write_back(made_.map);
  int moved = 0;
  for (const auto& [point, landmark] : made_.landmark_of) moved += error(point, landmark) < 0.009;
  EXPECT_EQ(moved, seen_by_three);
}

}  // namespace
}  // namespace vinebench::slam
