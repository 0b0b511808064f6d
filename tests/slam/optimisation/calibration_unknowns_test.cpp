// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/optimisation/calibration_unknowns.h"

#include <gtest/gtest.h>

#include "slam/optimisation/landmark_factors.h"
#include "tests/support/aisle_map.h"

namespace vinebench::slam {
namespace {

using test::AisleMap;
using test::SyntheticAisle;

/// All but the disparity offsets, with a deviation of 1 px, are as the rig, which has a camera for
/// tags, has them to 1e-4.
CalibrationBelief loose() {
  CalibrationBelief belief = CalibrationBelief::nothing(2, 1);
  belief.information.diagonal().setConstant(1e8);
  belief.information(6, 6) = belief.information(24, 24) = 1;
  return belief;
}

void solve(ProblemBuilder& problem) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 50;
  options.function_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  problem.solve(options);
}

// Poses are exact and disparities of the second pair 0.4 px too small: some hundred pixels, good to
// 3e-5 px, tell it to better than 1e-3 px, of which a belief of 0 with a deviation of 1 px takes
// nothing to speak of.
TEST(CalibrationUnknownsTest, AreFoundWithTheLandmarks) {
  SyntheticAisle aisle(0, 1, 500);
  aisle.calibration[1].disparity_offset = 0.4;
  AisleMap made(aisle, {});
  for (int k = 0; k < 4; ++k) {
    const Pose pose{exp_so3({0, 0, 0.02 * k}), {0.15 * k, 0.01 * k, 0}};
    made.add(aisle.frame(k, pose), pose);
  }
  ProblemBuilder problem(made.map, {{1, 2, 3}, {0}});
  for (const int id : {1, 2, 3}) problem.hold(problem.pose_of(id));
  CalibrationUnknowns unknowns(made.rig, loose());
  unknowns.add_to(problem, made.map);
  LandmarkFactors factors(made.rig, 2, &unknowns);
  factors.add_to(problem, made.map);
  solve(problem);
  EXPECT_NEAR(unknowns.found().pairs[0].disparity_offset, 0, 1e-2);
  EXPECT_NEAR(unknowns.found().pairs[1].disparity_offset, 0.4, 1e-2);
  // What is known afterwards has its mean there.
  const Eigen::VectorXd mean = unknowns.marginal(problem).belief.mean();
  EXPECT_LT((mean - to_vector(unknowns.found())).norm(), 1e-6);
}

/// x of the last of four keyframes, of which the first is held, when the second pair's disparity
/// offset is held there; and how that is to change by the offset.
std::pair<double, double> last_place(double offset, AisleMap& made) {
  ProblemBuilder problem(made.map, {{1, 2, 3}, {0}});
  CalibrationBelief held = loose();
  held.information.diagonal().setConstant(1e10);
  held.information_vector[24] = 1e10 * offset;
  CalibrationUnknowns unknowns(made.rig, held);
  unknowns.add_to(problem, made.map);
  LandmarkFactors factors(made.rig, 2, &unknowns);
  factors.add_to(problem, made.map);
  solve(problem);
  return {from_block(problem.pose_of(3)).translation.x(),
          unknowns.marginal(problem).of_last_pose(0, 24)};
}

// The difference of two adjustments, of 0.1 px, against what the first foretells: equal but for
// what is of second order in 0.1 px of some twenty, a hundredth.
TEST(CalibrationUnknownsTest, TheLastPoseFollowsThemAsForetold) {
  const SyntheticAisle aisle(0, 1, 500);
  AisleMap made(aisle, {});
  for (int k = 0; k < 4; ++k) {
    const Pose pose{Eigen::Quaterniond::Identity(), {0.15 * k, 0.01 * k, 0}};
    made.add(aisle.frame(k, pose), pose);
  }
  const auto [right, by_pixel] = last_place(0, made);
  const auto [wrong, again] = last_place(0.1, made);
  EXPECT_GT(std::abs(wrong - right), 1e-4);  // m
  EXPECT_NEAR((wrong - right) / 0.1, by_pixel, 0.03 * std::abs(by_pixel));
}

// Without factors the belief is what it was.
TEST(CalibrationUnknownsTest, WithoutFactorsTheBeliefStays) {
  const SyntheticAisle aisle(0, 1, 10);
  const AisleMap made(aisle, {Pose{}});
  ProblemBuilder problem(made.map, {{0}, {}});
  CalibrationUnknowns unknowns(made.rig, loose());
  unknowns.add_to(problem, made.map);
  const CalibrationBelief belief = unknowns.marginal(problem).belief;
  EXPECT_LT((belief.information - loose().information).norm(), 1e-12 * 1e8 * 37);  // rounding
  EXPECT_LT(belief.information_vector.norm(), 1e-9);
}

}  // namespace
}  // namespace vinebench::slam
