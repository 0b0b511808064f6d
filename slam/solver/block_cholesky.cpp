// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/block_cholesky.h"

#include <Eigen/Cholesky>

namespace vinebench::slam {

BlockCholesky::BlockCholesky(std::size_t size)
    : size_(size), blocks_(place_in_triangle(size, 0), Matrix6d::Zero()) {}

bool BlockCholesky::factor() {
  for (std::size_t row = 0; row < size_; ++row) {
    for (std::size_t column = 0; column <= row; ++column) {
      Matrix6d& block = at(row, column);
      const Matrix6d* left = row_of(row);
      const Matrix6d* above = row_of(column);
      for (std::size_t k = 0; k < column; ++k) {
        block.noalias() -= left[k].lazyProduct(above[k].transpose());
      }
      if (column < row) {
        const auto lower = above[column].triangularView<Eigen::Lower>();
        block = lower.solve(block.transpose().eval()).transpose().eval();
      } else {
        const Eigen::LLT<Matrix6d> llt(block);
        if (llt.info() != Eigen::Success) return false;
        block = llt.matrixL();
      }
    }
  }
  return true;
}

BlockVector BlockCholesky::solve(BlockVector x) const {
  for (std::size_t row = 0; row < size_; ++row) {
    const Matrix6d* blocks = row_of(row);
    for (std::size_t k = 0; k < row; ++k) x[row].noalias() -= blocks[k] * x[k];
    blocks[row].triangularView<Eigen::Lower>().solveInPlace(x[row]);
  }
  for (std::size_t row = size_; row-- > 0;) {
    const Matrix6d* blocks = row_of(row);
    blocks[row].transpose().triangularView<Eigen::Upper>().solveInPlace(x[row]);
    for (std::size_t k = 0; k < row; ++k) x[k].noalias() -= blocks[k].transpose() * x[row];
  }
  return x;
}

}  // namespace vinebench::slam
