// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/two_level.h"

#include <utility>

namespace vinebench::slam {

TwoLevel::TwoLevel(const BlockMatrix& matrix, BlockGroups groups)
    : groups_(std::move(groups)), rows_(groups_.count), bodies_(groups_.count) {
  std::vector<std::size_t> place(matrix.size());  // of a row in its group
  for (std::size_t row = 0; row < matrix.size(); ++row) {
    std::vector<std::size_t>& rows = rows_[groups_.group[row]];
    place[row] = rows.size();
    rows.push_back(row);
  }
  for (const std::vector<std::size_t>& rows : rows_) parts_.emplace_back(rows.size());
  matrix.for_each([&](std::size_t row, std::size_t column, const Matrix6d& block) {
    const std::size_t a = groups_.group[row], b = groups_.group[column];
    const Matrix6d of_bodies = groups_.modes[row].transpose() * (block * groups_.modes[column]);
    if (a > b) {
      bodies_.at(a, b) += of_bodies;
    } else if (a < b) {
      bodies_.at(b, a) += of_bodies.transpose();
    } else {
      parts_[a].at(place[row], place[column]) = block;
      bodies_.at(a, a) += of_bodies;
      if (row != column) bodies_.at(a, a) += of_bodies.transpose();
    }
  });
  for (BlockCholesky& part : parts_) definite_ = part.factor() && definite_;
  definite_ = bodies_.factor() && definite_;
}

BlockVector TwoLevel::solve(const BlockVector& right) const {
  BlockVector of_bodies(groups_.count, Vector6d::Zero());
  for (std::size_t row = 0; row < right.size(); ++row) {
    of_bodies[groups_.group[row]].noalias() += groups_.modes[row].transpose() * right[row];
  }
  of_bodies = bodies_.solve(std::move(of_bodies));
  BlockVector solution(right.size());
  for (std::size_t g = 0; g < groups_.count; ++g) {
    BlockVector part;
    for (const std::size_t row : rows_[g]) part.push_back(right[row]);
    part = parts_[g].solve(std::move(part));
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::size_t row = rows_[g][i];
      solution[row] = part[i] + groups_.modes[row] * of_bodies[g];
    }
  }
  return solution;
}

}  // namespace vinebench::slam
