// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/pose.h"

namespace vinebench::slam {

/// A vector in parts of six numbers.
using BlockVector = std::vector<Vector6d>;

double dot(const BlockVector& a, const BlockVector& b);

/// Where the blocks of a lower triangle stand in one array, row by row.
inline std::size_t place_in_triangle(std::size_t row, std::size_t column) {
  return row * (row + 1) / 2 + column;
}

/// A symmetric matrix of blocks of 6 × 6, of which few are not zero: those of the lower triangle
/// are kept, of the diagonal all. Blocks are told of first, then all is cleared, then they can be
/// asked for.
class BlockMatrix {
 public:
  /// Of `size` blocks a side.
  explicit BlockMatrix(std::size_t size);

  std::size_t size() const { return size_; }

  /// There will be a block of this row and column, and the same, transposed, of that column and
  /// row.
  void expect(std::size_t row, std::size_t column);

  /// Sets all blocks to zero. From the first call on none can be expected any more.
  void clear();

  /// A block that is expected; row >= column.
  Matrix6d& at(std::size_t row, std::size_t column) {
    return blocks_[static_cast<std::size_t>(slots_[place_in_triangle(row, column)])];
  }

  /// Calls `take(row, column, block)` for each block that is kept, row by row.
  template <class Take>
  void for_each(const Take& take) const {
    for (std::size_t row = 0; row < size_; ++row) {
      for (std::size_t b = rows_[row]; b < rows_[row + 1]; ++b) take(row, columns_[b], blocks_[b]);
    }
  }

  BlockVector operator*(const BlockVector& x) const;

 private:
  std::size_t size_;
  std::vector<int> slots_;         ///< by place in the triangle: of a block, or negative
  std::vector<std::size_t> rows_;  ///< first block of each, and the end; the diagonal comes last
  std::vector<std::size_t> columns_;
  std::vector<Matrix6d> blocks_;
};

}  // namespace vinebench::slam
