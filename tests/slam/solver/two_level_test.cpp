// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/two_level.h"

#include <gtest/gtest.h>

namespace vinebench::slam {
namespace {

/// Bodies in a line, each tied to the next by a spring of 1 along every axis, the first to the
/// ground by one of 1 too.
BlockMatrix springs(std::size_t size) {
  BlockMatrix matrix(size);
  for (std::size_t i = 1; i < size; ++i) matrix.expect(i, i - 1);
  matrix.clear();
  for (std::size_t i = 0; i < size; ++i) {
    matrix.at(i, i) = Matrix6d::Identity() * (i + 1 < size ? 2.0 : 1.0);
    if (i > 0) matrix.at(i, i - 1) = -Matrix6d::Identity();
  }
  return matrix;
}

BlockGroups in_runs(std::size_t size, std::size_t run) {
  BlockGroups groups;
  for (std::size_t i = 0; i < size; ++i) {
    groups.group.push_back(i / run);
    groups.modes.push_back(Matrix6d::Identity());
  }
  groups.count = groups.group.back() + 1;
  return groups;
}

TEST(TwoLevelTest, OneGroupIsSolvedByItselfAndAsABody) {
  // Pulled by 1 each, body i moves by the sum over the springs up to it of what hangs on them:
  // 3, 3 + 2, 3 + 2 + 1. As one body they hang on the first spring, and move by 3.
  const TwoLevel two_level(springs(3), in_runs(3, 3));
  ASSERT_TRUE(two_level.definite());
  const BlockVector solution = two_level.solve(BlockVector(3, Vector6d::Ones()));
  for (const auto& [i, expected] : {std::pair{0u, 3 + 3}, {1u, 5 + 3}, {2u, 6 + 3}}) {
    EXPECT_LT((solution[i] - Vector6d::Constant(expected)).norm(), 1e-12) << i;
  }
}

TEST(TwoLevelTest, AGroupMovesByItsModes) {
  // The second of two free bodies turns the other way round: pulled by 1 and -1 along every axis,
  // the group is pulled by 2, has the inertia 2, and moves by 1 and -1; so does each by itself.
  BlockMatrix matrix(2);
  matrix.clear();
  matrix.at(0, 0) = matrix.at(1, 1) = Matrix6d::Identity();
  BlockGroups groups = in_runs(2, 2);
  groups.modes[1] = -Matrix6d::Identity();
  const BlockVector solution =
      TwoLevel(matrix, groups).solve({Vector6d::Ones(), -Vector6d::Ones()});
  EXPECT_LT((solution[0] - Vector6d::Constant(2)).norm(), 1e-12);
  EXPECT_LT((solution[1] + Vector6d::Constant(2)).norm(), 1e-12);
}

TEST(TwoLevelTest, IsSymmetric) {
  const TwoLevel two_level(springs(8), in_runs(8, 3));
  const auto unit = [](std::size_t i) {
    BlockVector vector(8, Vector6d::Zero());
    vector[i](2) = 1;
    return vector;
  };
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NEAR(dot(unit(i), two_level.solve(unit(j))), dot(unit(j), two_level.solve(unit(i))),
                  1e-12);
    }
  }
}

TEST(TwoLevelTest, SaysThatAMatrixIsNotPositiveDefinite) {
  BlockMatrix matrix = springs(4);
  matrix.at(3, 3)(0, 0) = -1;
  EXPECT_FALSE(TwoLevel(matrix, in_runs(4, 2)).definite());
}

}  // namespace
}  // namespace vinebench::slam
