// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "slam/solver/block_matrix.h"

namespace vinebench::slam {

/// A symmetric matrix of blocks of 6 × 6, of which all of the lower triangle are kept, and its
/// Cholesky factor in their place. In a fixed order of operations, which no cache has a say in.
class BlockCholesky {
 public:
  /// A matrix of `size` blocks a side that is zero.
  explicit BlockCholesky(std::size_t size);

  /// A block of the matrix, before factor(); row >= column.
  Matrix6d& at(std::size_t row, std::size_t column) {
    return blocks_[place_in_triangle(row, column)];
  }

  /// False where the matrix is not positive definite.
  bool factor();

  /// After factor(): what the matrix times this makes `right`.
  BlockVector solve(BlockVector right) const;

 private:
  const Matrix6d* row_of(std::size_t row) const { return &blocks_[place_in_triangle(row, 0)]; }

  std::size_t size_;
  std::vector<Matrix6d> blocks_;
};

}  // namespace vinebench::slam
