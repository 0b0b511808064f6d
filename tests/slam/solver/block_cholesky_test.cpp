// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/block_cholesky.h"

#include <gtest/gtest.h>

#include "core/util/random.h"

namespace vinebench::slam {
namespace {

constexpr std::size_t kSize = 4;
constexpr int kRows = 6 * static_cast<int>(kSize);

/// A random matrix times its transpose, plus the identity: its eigenvalues are 1 or more.
Eigen::MatrixXd definite() {
  RandomSequence random(RandomStream(1, "cholesky"));
  Eigen::MatrixXd half(kRows, kRows);
  for (double& x : half.reshaped()) x = random.normal();
  return half * half.transpose() + Eigen::MatrixXd::Identity(kRows, kRows);
}

BlockCholesky blocks_of(const Eigen::MatrixXd& matrix) {
  BlockCholesky blocks(kSize);
  for (std::size_t row = 0; row < kSize; ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      blocks.at(row, column) =
          matrix.block<6, 6>(6 * static_cast<int>(row), 6 * static_cast<int>(column));
    }
  }
  return blocks;
}

TEST(BlockCholeskyTest, SolvesWhatTheMatrixMakesOfAVector) {
  const Eigen::MatrixXd matrix = definite();
  Eigen::VectorXd x(kRows);
  for (int i = 0; i < kRows; ++i) x(i) = i - 10;
  const Eigen::VectorXd made = matrix * x;
  BlockVector right;
  for (int i = 0; i < kRows; i += 6) right.push_back(made.segment<6>(i));
  BlockCholesky blocks = blocks_of(matrix);
  ASSERT_TRUE(blocks.factor());
  const BlockVector solution = blocks.solve(right);
  // Its condition is about 1e2, so that of 16 digits 13 are left, of numbers up to 13.
  for (std::size_t i = 0; i < kSize; ++i) {
    EXPECT_LT((solution[i] - x.segment<6>(6 * static_cast<int>(i))).norm(), 1e-11) << i;
  }
}

TEST(BlockCholeskyTest, SaysThatAMatrixIsNotPositiveDefinite) {
  Eigen::MatrixXd matrix = definite();
  matrix(kRows - 1, kRows - 1) = -1;
  BlockCholesky blocks = blocks_of(matrix);
  EXPECT_FALSE(blocks.factor());
}

}  // namespace
}  // namespace vinebench::slam
