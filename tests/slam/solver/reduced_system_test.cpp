// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/reduced_system.h"

#include <ceres/normal_prior.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "slam/factors/relative_pose_factor.h"
#include "tests/support/loop_problem.h"

namespace vinebench::slam {
namespace {

using test::LoopProblem;

constexpr std::size_t kBodies = 24;
constexpr int kPoses = 6 * (static_cast<int>(kBodies) - 1);
constexpr int kPoints = 3 * 60;

/// With ties between poses, of which one is held, and a block of three numbers.
struct ReducedSystemTest : testing::Test {
  ReducedSystemTest() : loop(kBodies, 60, 0.01) {
    loop.perturb(0.01);
    for (const auto& [from, to] : {std::pair{0u, 3u}, {4u, 2u}}) {
      loop.tie(tie, {loop.poses[from].data(), loop.poses[to].data()});
    }
    loop.tie(*prior, {shorter.data()});
    loop.unknowns.poses.push_back(shorter.data());
  }

  LoopProblem loop;
  RelativePoseFactor tie{{}, Matrix6d::Identity()};
  Eigen::Vector3d shorter{1, 2, 3};
  // To be deleted where it was made, as vectors of the library are not ours with a sanitizer.
  std::unique_ptr<ceres::CostFunction> prior = std::make_unique<ceres::NormalPrior>(
      Eigen::Matrix3d::Identity() * 2, Eigen::Vector3d(1, 1, 1));
};

/// Points first, then poses, of the damped normal equations of all.
struct Whole {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd gradient;
};

Whole whole(LoopProblem& loop) {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = loop.unknowns.points;
  options.parameter_blocks.insert(options.parameter_blocks.end(), loop.unknowns.poses.begin() + 1,
                                  loop.unknowns.poses.begin() + kBodies);
  std::vector<double> residuals;
  ceres::CRSMatrix crs;
  loop.all.Evaluate(options, nullptr, &residuals, nullptr, &crs);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(crs.num_rows, crs.num_cols);
  for (int row = 0; row < crs.num_rows; ++row) {
    for (auto i = static_cast<std::size_t>(crs.rows[static_cast<std::size_t>(row)]);
         i < static_cast<std::size_t>(crs.rows[static_cast<std::size_t>(row) + 1]); ++i) {
      J(row, crs.cols[i]) = crs.values[i];
    }
  }
  const Eigen::Map<Eigen::VectorXd> r(residuals.data(), crs.num_rows);
  return {J.transpose() * J, J.transpose() * r};
}

TEST_F(ReducedSystemTest, IsTheSchurComplementOfThePoints) {
  const Whole all = whole(loop);
  const Eigen::MatrixXd points = all.matrix.topLeftCorner<kPoints, kPoints>();
  const Eigen::MatrixXd cross = all.matrix.bottomLeftCorner<kPoses, kPoints>();
  const Eigen::LLT<Eigen::MatrixXd> inverse(points);
  const Eigen::MatrixXd expected =
      all.matrix.bottomRightCorner<kPoses, kPoses>() - cross * inverse.solve(cross.transpose());
  const Eigen::VectorXd gradient =
      all.gradient.tail<kPoses>() - cross * inverse.solve(all.gradient.head<kPoints>());

  const Terms terms = read_terms(loop.problem, loop.unknowns);
  ReducedSystem system(terms);
  system.linearise(0);
  // Sums of a few hundred products that cancel to no less than a thousandth: 1e-12 of the largest.
  const double tolerance = 1e-12 * all.matrix.cwiseAbs().maxCoeff();
  system.matrix().for_each([&](std::size_t row, std::size_t column, const Matrix6d& block) {
    if (row == kBodies - 1) return;  // the shorter block
    const Matrix6d there =
        expected.block<6, 6>(6 * static_cast<int>(row), 6 * static_cast<int>(column));
    EXPECT_LT((block - there).cwiseAbs().maxCoeff(), tolerance) << row << " " << column;
  });
  for (std::size_t i = 0; i + 1 < kBodies; ++i) {
    const Vector6d there = gradient.segment<6>(6 * static_cast<int>(i));
    EXPECT_LT((system.gradient()[i] - there).norm(), tolerance) << i;
  }
}

TEST_F(ReducedSystemTest, AShorterBlockIsFilledUpWithOnes) {
  const Terms terms = read_terms(loop.problem, loop.unknowns);
  ReducedSystem system(terms);
  system.linearise(0);
  // Of the residuals 2 (x - 1), the squares' second derivative is 4, their gradient 4 (x - 1).
  system.matrix().for_each([](std::size_t row, std::size_t column, const Matrix6d& block) {
    if (row != kBodies - 1) return;
    EXPECT_EQ(column, row);
    Vector6d diagonal;
    diagonal << 4, 4, 4, 1, 1, 1;
    EXPECT_EQ(block, Matrix6d(diagonal.asDiagonal()));
  });
  Vector6d gradient;
  gradient << 0, 4, 8, 0, 0, 0;
  EXPECT_EQ(system.gradient().back(), gradient);
}

TEST_F(ReducedSystemTest, PointsStepAsTheWholeSystemHasThem) {
  const Whole all = whole(loop);
  const Eigen::VectorXd expected = -all.matrix.llt().solve(all.gradient);
  BlockVector of_poses;
  for (int i = 0; i < kPoses; i += 6) of_poses.push_back(expected.segment<6>(kPoints + i));
  of_poses.push_back(Vector6d::Zero());
  const Terms terms = read_terms(loop.problem, loop.unknowns);
  ReducedSystem system(terms);
  system.linearise(0);
  const std::vector<Eigen::Vector3d> steps = system.points_steps(of_poses);
  ASSERT_EQ(steps.size(), static_cast<std::size_t>(kPoints / 3));
  // Steps of centimetres, of a system whose condition is some 1e5.
  for (std::size_t p = 0; p < steps.size(); ++p) {
    EXPECT_LT((steps[p] - expected.segment<3>(3 * static_cast<int>(p))).norm(), 1e-12) << p;
  }
}

TEST_F(ReducedSystemTest, DampingHoldsPosesByAThousandthOfIt) {
  const Terms terms = read_terms(loop.problem, loop.unknowns);
  ReducedSystem free(terms), damped(terms);
  free.linearise(0);
  damped.linearise(1e9);
  // Points that are held as firmly take nothing from the poses: what is left is their own diagonal
  // and a million times that. Of the shorter block it is 4.
  std::vector<Matrix6d> blocks;
  damped.matrix().for_each([&](std::size_t row, std::size_t column, const Matrix6d& block) {
    if (row == column) blocks.push_back(block);
  });
  EXPECT_NEAR(blocks.back()(0, 0), 4 + 4e6, 1e-6);
  EXPECT_EQ(blocks.back()(5, 5), 1);
}

}  // namespace
}  // namespace vinebench::slam
