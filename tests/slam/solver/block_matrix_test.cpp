// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/block_matrix.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

Matrix6d numbered(double first) {
  Matrix6d block;
  for (int i = 0; i < 36; ++i) block(i / 6, i % 6) = first + i;
  return block;
}

// Three blocks a side of which (2, 0) is zero; the diagonal is symmetric by itself.
BlockMatrix example() {
  BlockMatrix matrix(3);
  matrix.expect(0, 1);  // either order
  matrix.expect(2, 1);
  matrix.clear();
  matrix.at(1, 0) = numbered(1);
  matrix.at(2, 1) = numbered(100);
  for (std::size_t i = 0; i < 3; ++i) matrix.at(i, i) = Matrix6d::Identity() * (1.0 + i);
  return matrix;
}

TEST(BlockMatrixTest, TimesAVectorIsTheWholeSymmetricMatrixTimesIt) {
  Eigen::Matrix<double, 18, 18> whole = Eigen::Matrix<double, 18, 18>::Zero();
  whole.block<6, 6>(6, 0) = numbered(1);
  whole.block<6, 6>(0, 6) = numbered(1).transpose();
  whole.block<6, 6>(12, 6) = numbered(100);
  whole.block<6, 6>(6, 12) = numbered(100).transpose();
  for (int i = 0; i < 3; ++i) whole.block<6, 6>(6 * i, 6 * i) = Matrix6d::Identity() * (1.0 + i);
  Eigen::Matrix<double, 18, 1> x;
  for (int i = 0; i < 18; ++i) x(i) = i - 7;
  const BlockVector product = example() * BlockVector{x.head<6>(), x.segment<6>(6), x.tail<6>()};
  // Whole numbers below 2^53 are exact in any order.
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(product[static_cast<std::size_t>(i)], (whole * x).segment<6>(6 * i)) << i;
  }
}

TEST(BlockMatrixTest, GivesItsBlocksRowByRow) {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  example().for_each([&](std::size_t row, std::size_t column, const Matrix6d&) {
    places.emplace_back(row, column);
  });
  const std::vector<std::pair<std::size_t, std::size_t>> expected{
      {0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}};
  EXPECT_EQ(places, expected);
}

TEST(BlockMatrixTest, ClearedItHasTheSameBlocksOfZero) {
  BlockMatrix matrix = example();
  matrix.clear();
  int count = 0;
  matrix.for_each([&](std::size_t, std::size_t, const Matrix6d& block) {
    EXPECT_TRUE(block.isZero(0));
    ++count;
  });
  EXPECT_EQ(count, 5);
}

TEST(BlockMatrixTest, DotIsTheSumOverAllParts) {
  // 6 x 1 x 2 + 6 x 3 x 4 = 84
  const BlockVector a{Vector6d::Constant(1), Vector6d::Constant(3)};
  const BlockVector b{Vector6d::Constant(2), Vector6d::Constant(4)};
  EXPECT_EQ(dot(a, b), 84);
}

}  // namespace
}  // namespace vinebench::slam
