// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "slam/solver/block_cholesky.h"
#include "slam/solver/block_matrix.h"

namespace vinebench::slam {

/// Unknowns in groups, each of which can also move as one body.
struct BlockGroups {
  std::vector<std::size_t> group;  ///< of each row, from 0 on without a gap
  std::vector<Matrix6d> modes;     ///< of each row: its step for a step of its group
  std::size_t count = 0;           ///< of groups
};

/// A preconditioner for conjugate gradients. Each group is solved by itself, which takes care of
/// what is near each other; beside that all groups are, each as one body, which takes care of what
/// bends the whole, where steps from neighbour to neighbour would take long (additive Schwarz with
/// a coarse space: Toselli and Widlund, "Domain Decomposition Methods", 2005, ch. 2 and 3).
class TwoLevel {
 public:
  TwoLevel(const BlockMatrix& matrix, BlockGroups groups);

  /// Whether the matrix is positive definite, as far as groups and bodies show. Nothing can be
  /// solved where it is not.
  bool definite() const { return definite_; }

  /// About what the matrix times this makes `right`.
  BlockVector solve(const BlockVector& right) const;

 private:
  BlockGroups groups_;
  std::vector<std::vector<std::size_t>> rows_;  ///< of each group
  std::vector<BlockCholesky> parts_;
  BlockCholesky bodies_;
  bool definite_ = true;
};

}  // namespace vinebench::slam
