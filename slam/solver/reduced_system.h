// SPDX-FileCopyrightText: Vinebench authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "slam/solver/block_matrix.h"
#include "slam/solver/terms.h"

namespace vinebench::slam {

/// The normal equations of a problem's poses, its points eliminated (Schur complement), where the
/// factors are linearised at the blocks' values: matrix * steps = -gradient. A pose's step is that
/// of its manifold; of a shorter block the last numbers of its step have ones on the diagonal.
class ReducedSystem {
 public:
  /// The terms must outlive it.
  explicit ReducedSystem(const Terms& terms);

  /// `damping` is added to the diagonal of the points' own equations, and a thousandth of it to
  /// that of the poses', as a share of it (Levenberg-Marquardt): points may be held weakly, poses
  /// of a map are not, and what bends it as a whole is a small share of what holds each.
  void linearise(double damping);

  const BlockMatrix& matrix() const { return matrix_; }
  const BlockVector& gradient() const { return gradient_; }

  /// The points' steps where the poses make these. Blocks must be as they were at linearise():
  /// what is between points and poses is linearised again, as it is most of all numbers.
  std::vector<Eigen::Vector3d> points_steps(const BlockVector& steps) const;

 private:
  using Cross = Eigen::Matrix<double, 6, 3>;
  struct Point {
    Eigen::Matrix3d inverse;
    Eigen::Vector3d gradient;
  };

  void eliminate(std::size_t p, const std::vector<Pose>& poses, double damping);
  void add(const Tie& tie);
  void damp(double damping);

  const Terms& terms_;
  BlockMatrix matrix_;
  BlockVector gradient_;
  BlockVector diagonal_;  ///< of the poses' own equations, before points are eliminated
  std::vector<Point> points_;
  std::vector<Cross> crosses_;  ///< of the point at hand, and their poses
  std::vector<std::size_t> crossed_;
};

}  // namespace vinebench::slam
