// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#include "slam/solver/block_matrix.h"

#include <algorithm>

namespace vinebench::slam {
namespace {

// Slots of no block.
constexpr int kAbsent = -1;
constexpr int kExpected = -2;

}  // namespace

double dot(const BlockVector& a, const BlockVector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

BlockMatrix::BlockMatrix(std::size_t size)
    : size_(size), slots_(place_in_triangle(size, 0), kAbsent) {
  for (std::size_t i = 0; i < size; ++i) expect(i, i);
}

void BlockMatrix::expect(std::size_t row, std::size_t column) {
  slots_[place_in_triangle(std::max(row, column), std::min(row, column))] = kExpected;
}

void BlockMatrix::clear() {
  if (rows_.empty()) {
    rows_.push_back(0);
    for (std::size_t row = 0; row < size_; ++row) {
      for (std::size_t column = 0; column <= row; ++column) {
        int& slot = slots_[place_in_triangle(row, column)];
        if (slot != kExpected) continue;
        slot = static_cast<int>(columns_.size());
        columns_.push_back(column);
      }
      rows_.push_back(columns_.size());
    }
  }
  blocks_.assign(columns_.size(), Matrix6d::Zero());
}

BlockVector BlockMatrix::operator*(const BlockVector& x) const {
  BlockVector product(size_, Vector6d::Zero());
  for (std::size_t row = 0; row < size_; ++row) {
    const std::size_t diagonal = rows_[row + 1] - 1;
    Vector6d sum = blocks_[diagonal] * x[row];
    for (std::size_t b = rows_[row]; b < diagonal; ++b) {
      sum.noalias() += blocks_[b] * x[columns_[b]];
      product[columns_[b]].noalias() += blocks_[b].transpose() * x[row];
    }
    product[row] += sum;
  }
  return product;
}

}  // namespace vinebench::slam
